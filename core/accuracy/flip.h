#pragma once
#include <vector>

/// The perceived difference of two pictures.
namespace tyndall {

/// The difference that an eye sees when two pictures are shown in turn (FLIP): one number for each pixel, top row
/// first, in [0, 1]; 0 where both look the same. The formula is symmetric: swapping image and reference changes no bit.
/// Both are linear Rec.709, 3 floats a pixel, and are shown as sRGB clipped to [0, 1]; values that are not a number
/// count as black. 67 pixels a degree: a screen of 0.7 m with 3840 pixels seen from 0.7 m. Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström, Fairchild, FLIP: A Difference Evaluator for Alternating Images, Proc. ACM Comput.
/// Graph. Interact. Tech. 3 (2020).
std::vector<float> flip_map(const std::vector<float>& image, const std::vector<float>& reference, int width,
                            int height);

}  // namespace tyndall
