#pragma once
#include "app/cli/pictures.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// What an earlier run has left of the pictures that a command is to make, so that a killed one goes on.
namespace tyndall {

/// Looks at the film in the .exr output, or in the unfinished file beside it (see FilmPlace) if that is there. One that
/// fits is gone on with if it is unfinished, has just the samples that are asked for, or --resume asks for it. Throws
/// UsageError where --resume finds no film that fits, and for an unfinished one that does not fit: it says what
/// differs; likewise for unfinished ones in further outputs. Any other file is replaced in the end. Here and below the
/// job has been set up.
void find_start(RenderJob& job);

enum class PictureState { nothing, unfinished, whole };

/// What is left to do for a picture of which an earlier run may have written some files.
struct PictureTask {
  std::vector<std::filesystem::path> outputs;  ///< files that are not whole
  std::filesystem::path film;                  ///< the first whole file that holds its film; empty: none does
};
/// look: what there is of each output, which is not asked with --fresh.
PictureTask task_of(const RenderJob& job, const std::function<PictureState(const std::filesystem::path& file)>& look);

/// What there is of a job's picture in a PNG or EXR. Throws UsageError if the file is of something else: it holds no
/// picture of the same scene, settings and version.
PictureState look_at_picture(const std::filesystem::path& file, const RenderJob& job);

/// A list beside numbered pictures of formats that carry no settings: which frames are whole, and what they are of.
///
/// Lines are only ever added, so that several machines can write into one list, and a line that was cut off by a kill
/// costs one frame: "3 begun 0123456789abcdef" before the frame's file is written, "3 whole 0123456789abcdef" after it.
class FrameList {
 public:
  struct Entry {
    std::string mark;  ///< 16 hexadecimal digits: what the frame is of
    bool whole = false;
  };

  /// Reads the list, which need not be there.
  explicit FrameList(std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  /// What the list says of a frame; null: nothing.
  const Entry* find(int frame) const;
  /// Throws IoError.
  void add(int frame, const Entry& entry);

 private:
  std::filesystem::path file_;
  std::map<int, Entry> entries_;
};

/// The same as look_at_picture() for formats that carry no settings, by a list beside them. mark: see picture_mark().
PictureState look_at_list(const std::filesystem::path& file, const FrameList& list, int frame, const std::string& mark);

/// 16 hexadecimal digits that differ with the job's scene, settings, version and instruction set.
std::string picture_mark(const RenderJob& job);

}  // namespace tyndall
