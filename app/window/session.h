#pragma once
#include "app/window/accuracy/references.h"
#include "app/window/document/autosave.h"
#include "app/window/document/numbered_files.h"
#include "app/window/rendering/renderer_pair.h"
#include "app/window/system/pacing.h"
#include "app/window/system/preferences.h"
#include "app/window/window.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

/// The window without its drawing and its input, so that tests can use it without a display.
namespace tyndall {

/// Pixels of a picture.
struct PictureSize {
  int width = 0, height = 0;
  bool operator==(const PictureSize&) const = default;
};

/// All that a window does apart from drawing and input. Its parts do the work: the editor holds the document, the pair
/// of renderers makes pictures of it, the accuracy measures them. The session does what concerns several of them. For
/// the main thread; never waits for rendering or for files.
class Session {
 public:
  /// wake: called from any thread when collect() has something to do; on_frame: from a renderer's thread, after each
  /// frame; log: may be null.
  Session(const WindowOptions& options, const std::function<void()>& wake, std::function<void()> on_frame, UiLog* log);
  /// Finishes what is being saved.
  ~Session();

  /// Whether what is shown is a picture that another program writes, without a scene that could be edited.
  bool shows_picture() const { return editor.document().origin->is_picture; }
  /// Whether what is shown is rendered: a scene, or a picture whose samples a caller's function computes.
  bool renders() const { return !shows_picture() || function_ != nullptr; }
  /// How much of an arriving picture is there, a few words; "": none is shown.
  std::string arrived() const;

  /// Asks the renderers for what is wanted now, in each drawing. The edited scene becomes part of that when its time
  /// has come, see SendTimer, if scene_too. Returns whether it did.
  bool send(double now, bool scene_too = true);
  /// A frame is about to be drawn: for the chart.
  void shown(Half half, const std::shared_ptr<const Frame>& frame);
  /// Takes what the background has done, a changed file, a problem of the renderer. Whether anything came.
  bool collect();
  /// Whether nothing will change until something happens: the pictures are finished, and nothing is being read, written
  /// or measured.
  bool at_rest() const;

  /// Hands edits that are not saved to the file that keeps them, if there are new ones.
  void keep_edits();
  /// Waits until that file holds the newest edits, and returns what becomes of them if the program ends now, a
  /// sentence;
  /// "": there are none. From any thread; only the main thread may edit meanwhile.
  std::string flush_edits() {
    kept_.flush();
    return kept_.last_words();
  }
  /// Waits until no file is being written any more, for a window that is about to go. Returns what could not be
  /// written, a sentence; "": all was.
  std::string finish_files();
  /// Edits that no file has; null: there are none. What is changed about a picture without a scene is no edit.
  const Document* unsaved() const;
  /// The user does not want the edits: they are not kept any longer.
  void discard_edits();
  /// Pixels of the picture, in place of those that the scene's file asks for; nothing: as the file asks. What is saved
  /// keeps the file's.
  void set_picture_size(std::optional<PictureSize> size);
  const std::optional<PictureSize>& picture_size() const { return picture_size_; }

  /// number: see view_entry().
  void show_view(int number);
  int view() const { return view_; }
  /// Writes the preferences in the background, if they were changed.
  void keep_preferences();
  bool clean() const { return preferences.clean && !shows_picture(); }
  /// The picture as it is on the left, the clean view on the right, while the clean view is on and nothing else is
  /// compared.
  void set_clean_beside_raw(bool beside);
  bool clean_beside_raw() const { return beside_ && clean() && !split(); }
  /// Side by side: on the left the settings that the scene has now, on the right those that it will have, each for as
  /// many core-seconds. Both start anew.
  void set_split(bool split);
  bool split() const { return kept_scene_ != nullptr; }
  /// Ends the split view and goes on with the settings of that half; those of the left one are an edit.
  void keep_half(Half half);

  /// "mis · sobol": how a half is rendered.
  std::string method(Half half) const;
  /// Whether there is something to measure the picture against.
  bool can_show_errors() const;
  /// Renders a reference of the scene on the screen in the background, with as many samples as the picture has and
  /// other random numbers: its own ones would make its error look smaller than it is.
  void render_reference();
  /// The same of another scene of the same size, which the picture on the screen should look like.
  void render_reference(const LoadedScene& loaded);
  /// Writes the picture as numbered files into the current folder, in the background.
  void snapshot();
  /// Writes the chart's curves as numbered files beside the snapshots, in the background.
  void export_chart();

 private:
  void submit(double now);
  bool ask();
  std::shared_ptr<const Scene> with_kept_settings(const Scene& scene) const;
  std::shared_ptr<const Scene> rendered_scene();
  bool tell_of_keeping();
  bool collect_rows();
  bool collect_problem();
  std::shared_ptr<const SampleSource> source() const;
  void restore_edits(const WindowOptions& options);
  void read_preferences_file();
  void pause_at_limits(const Frame& frame);

  std::shared_ptr<Film> opened_film_;        ///< of the scene that was opened, until it goes to the renderer
  std::shared_ptr<const Scene> kept_scene_;  ///< of the left half of a split view; null: there is none
  std::string isa_;                          ///< "": the best
  PauseLimits limits_;
  std::uint64_t limited_edit_ = 0;                     ///< the picture of this edit was paused by a limit; 0: none
  std::shared_ptr<const RenderProblem> told_problem_;  ///< the newest one
  std::atomic<bool> closing_ = false;
  bool beside_ = false;  ///< the clean view beside the raw one
  int view_ = 0;
  std::optional<PictureSize> picture_size_;
  Preferences kept_preferences_;                         ///< as the file has them
  std::uint64_t kept_changes_ = 0;                       ///< Editor::changes() when the edits were kept last
  bool discarded_ = false;                               ///< edits are not kept any more
  Keeping::Kind told_keeping_ = Keeping::Kind::nothing;  ///< what the user was told last
  Autosave kept_;
  std::shared_ptr<ArrivingPicture> picture_;   ///< null: none was given
  Arrival arrival_;                            ///< of the picture, as it is known here
  std::shared_ptr<WatchedFunction> function_;  ///< null: none was given
  std::string told_function_problem_;          ///< what the user was told of it

 public:
  /// What the renderers are asked for, in a split view of the right half. Goes to them with the next send(); all parts
  /// but the scene, its film and `clean` can be changed here.
  RenderRequest wanted;
  /// When the input came that the next edits are due to, in clock seconds; latencies are counted from then on. 0: they
  /// are not due to input.
  double input_time = 0;
  SendTimer timer;
  Pacing pacing;  ///< of the drawings
  UiLog* log;     ///< null: none
  MessageLine messages;
  Preferences preferences;  ///< see keep_preferences()
  LiveAccuracy accuracy;
  RendererPair renderers;
  Editor editor;
  References references;

 private:
  NumberedFiles snapshots_, charts_;
  JobQueue loading_;

 public:
  JobQueue saving;  ///< what is being written: a snapshot is one job. Last: its jobs use the others
};

}  // namespace tyndall
