#include "app/book/program_layout.h"

#include "app/book/camera_constructor.h"
#include "app/book/namespaces.h"
#include "app/book/project_headers.h"
#include "app/book/scratch_folder.h"
#include "app/book/source_text.h"
#include "app/text/values.h"
#include "core/base/text.h"

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

/// Further names of the books' headers, and of classes that readers put into headers of their own.
constexpr std::string_view other_headers[] = {"bvhnode",      "checkertexture", "colour",       "dielectric",
                                              "diffuselight", "flipface",       "imagetexture", "isotropic",
                                              "lambertian",   "metal",          "noisetexture", "rect",
                                              "rotatey",      "solidcolor",     "translate",    "xyrect"};

template <std::size_t count>
bool contains(const std::string_view (&list)[count], const std::string& name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

bool is_book_class(const std::string& name) { return !book_class(name).empty(); }

/// Whether a header with another name does what one of the books' does.
bool replaces_ours(const std::string& code) {
  for (const auto& [name, base] : classes_of(code))
    if (is_book_class(name)) return true;
  const std::vector<std::string> constants = constants_of(code);
  const bool endless = std::find(constants.begin(), constants.end(), "infinity") != constants.end();
  const bool degrees = has_name(code, "degrees_to_radians") && has_name(code, "return");
  return endless || degrees || code.find("double random_double") != std::string::npos;
}

/// Takes away `class Ray;`, where that is another name of ours, which such a line cannot announce.
void blank_out_announced_classes(std::string& text) {
  static const std::regex announced(R"(\b(?:class|struct)\s+(\w+)\s*;)");
  std::string out = text;
  for (std::sregex_iterator at(text.begin(), text.end(), announced), end; at != end; ++at)
    if (const std::string name = (*at)[1]; is_book_class(name) && book_class(name) != name)
      for (std::size_t k = 0; k < static_cast<std::size_t>(at->length()); ++k) {
        char& sign = out[static_cast<std::size_t>(at->position()) + k];
        if (sign != '\n') sign = ' ';
      }
  text = std::move(out);
}

class Layouter {
 public:
  Layouter(const ProgramSources& sources, const fs::path& headers)
      : sources_(sources), headers_(headers), project_headers_(sources.files.front().parent_path()) {}

  ProgramLayout lay_out() {
    for (const fs::path& file : sources_.files) layout_.compiled_files.push_back(add(file, file.string(), ".cpp"));
    std::erase_if(layout_.further_files, [&](const std::string& file) {
      return std::find(layout_.compiled_files.begin(), layout_.compiled_files.end(), file) !=
             layout_.compiled_files.end();
    });
    if (!uses_books_)
      throw UsageError(printable(sources_.files.front().string()) +
                       ": includes none of the books' headers (vec3.h, hittable.h, camera.h ...), so there is no scene "
                       "that Tyndall could take over");
    layout_.options = random_options(random_text_.empty() ? all_text_ : random_text_);
    for (const std::string& name : constants_) {
      if (name == "pi") layout_.options.emplace_back("-DTYNDALL_BOOK_NO_PI");
      if (name == "infinity") layout_.options.emplace_back("-DTYNDALL_BOOK_NO_INFINITY");
    }
    for (const auto& [name, base] : classes_of(all_text_))
      for (const std::string_view shape : {"tri", "triangle", "ellipse", "disk", "annulus"})
        if (name == shape) layout_.options.push_back("-DTYNDALL_BOOK_OWN_" + name);
    layout_.texts[our_headers] = "#pragma once\n" + camera_constructor_ + camera_defaults_ +
                                 "#include <rtweekend.h>\n" + namespaces_ + "#include \"" + std::string(own_names) +
                                 "\"\n";
    layout_.texts[own_names] = "";
    return std::move(layout_);
  }

 private:
  /// Reads a file of the reader's. Returns its code without comments; text: all of it.
  std::string read(const fs::path& file, std::string& text) {
    text = read_text(file);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    if (std::find(layout_.files.begin(), layout_.files.end(), file) == layout_.files.end())
      layout_.files.push_back(file);
    std::string code = without_comments(text);
    all_text_ += code;
    add_data(code);
    return code;
  }

  /// Adds a file that is compiled, or included by one. Returns its name in the folder where that happens.
  std::string add(const fs::path& file, const std::string& shown, const char* ending) {
    std::string known = copies_[identity(file)];
    if (!known.empty()) return known;
    std::string name = "file_" + std::to_string(copies_.size()) + ending;
    copies_[identity(file)] = name;
    layout_.shown_names.push_back(shown);
    std::string text;
    const std::string code = read(file, text);
    for (std::string& constant : constants_of(code)) constants_.insert(std::move(constant));
    if (ending == std::string(".h")) layout_.own_headers[name] = {shown, definitions_of(code)};
    for (const auto& [own, base] : classes_of(code))
      if (!base.empty()) layout_.own_classes[own] = {base, shown};
    blank_out_announced_classes(text);
    std::string out = "#line 1 \"" + escaped(shown) + "\"\n";
    std::size_t done = 0;
    for (const Include& include : includes_of(text)) {
      const std::string replacement = replacement_of(include, file, shown);
      if (replacement.empty()) continue;
      out += text.substr(done, include.line_begin - done) + "#include " + replacement;
      done = include.line_end;
    }
    // A copy is included once, even where the reader's header says so by #pragma once, which would be a matter of its
    // name.
    layout_.texts[name] =
        std::string(ending == std::string(".h") ? "#pragma once\n" : "") + out + text.substr(done) + "\n";
    return name;
  }

  /// What is included in place of it; empty: it stays.
  std::string replacement_of(const Include& include, const fs::path& from, const std::string& shown) {
    std::string found_as;
    const fs::path found = find(include, from, shown, found_as);
    const std::string key = key_of(include.name);
    if (is_ours(key) && (include.quoted || !found.empty())) return ours(found, found_as);
    if (found.empty() || (!include.quoted && is_in_given_folder(include.name))) return "";
    std::string text = without_comments(read_text(found));
    if (replaces_ours(text)) return ours(found, found_as);
    const std::string name = add(found, found_as, ".h");
    const fs::path source = source_of(found);
    if (!source.empty() && copies_[identity(source)].empty())
      layout_.further_files.push_back(add(source, beside(found_as, source), ".cpp"));
    return "\"" + name + "\"";
  }

  bool is_in_given_folder(const std::string& name) const {
    std::error_code error;
    return std::any_of(sources_.include_folders.begin(), sources_.include_folders.end(),
                       [&](const fs::path& folder) { return fs::is_regular_file(folder / name, error); });
  }

  std::string ours(const fs::path& replaced, const std::string& shown) {
    uses_books_ = true;
    if (!replaced.empty()) see(replaced, shown);
    return "\"" + std::string(our_headers) + "\"";
  }

  /// Looks at a header that ours take the place of, and at those that it includes.
  void see(const fs::path& file, const std::string& shown) {
    if (!seen_.insert(identity(file)).second) return;
    std::string text;
    const std::string code = read(file, text);
    for (const char* name : {"random_double", "randomDouble", "random_float"})
      if (has_name(code, name)) random_text_ += code;
    const std::map<std::string, std::string> classes = classes_of(code);
    for (const auto& [name, base] : classes)
      if (!is_book_class(name)) layout_.own_classes[name] = {base, shown};
    if (camera_constructor_.empty()) camera_constructor_ = camera_constructor(code);
    if (has_name(code, "ray_color") && (classes.contains("camera") || classes.contains("Camera"))) {
      const auto sky = sky_of(code);
      layout_.sky = sky.value_or("");
      layout_.unknown_sky = !sky;
    }
    for (const Include& include : includes_of(text)) {
      std::string found_as;
      const fs::path found = find(include, file, shown, found_as);
      if (!found.empty()) see(found, found_as);
    }
    std::vector<Definition> definitions, of_books;
    sort(definitions_of(code), definitions, of_books);
    layout_.replaced.push_back({shown, std::move(definitions), std::move(of_books)});
    const fs::path source = source_of(file);
    if (!source.empty()) see(source, beside(shown, source));
  }

  /// Tells what ours take the place of from the rest. Namespaces of the reader's with the books' names are opened.
  void sort(const std::vector<Definition>& all, std::vector<Definition>& own, std::vector<Definition>& of_books) {
    for (const Definition& one : all) {
      if (one.is_namespace && is_of_the_books(one)) {
        namespaces_ += namespace_of_ours(one);
        std::vector<Definition> inside = members_of(one.text);
        const auto open = static_cast<long>(one.text.find('{'));
        const auto lines_above =
            one.line - 1 + static_cast<std::size_t>(std::count(one.text.begin(), one.text.begin() + open, '\n'));
        for (Definition& member : inside) member.line += lines_above;
        sort(inside, own, of_books);
        continue;
      }
      const bool is_of_books = is_of_the_books(one);
      (is_of_books ? of_books : own).push_back(one);
      if (is_of_books && camera_defaults_.empty()) camera_defaults_ = camera_defaults(one.text);
    }
  }

  /// The source file that belongs to a header: where that has prototypes, it has the functions. Empty: there is none.
  fs::path source_of(const fs::path& header) const {
    if (header.extension() == ".cc" || header.extension() == ".cpp" || header.extension() == ".cxx") return {};
    std::error_code error;
    const fs::path own = header.parent_path(), main = sources_.files.front().parent_path();
    for (const fs::path& folder : {own, own / ".." / "src", main})
      for (const char* ending : {".cc", ".cpp", ".cxx"}) {
        const fs::path file = (folder / header.stem()).replace_extension(ending).lexically_normal();
        if (fs::is_regular_file(file, error)) return file;
      }
    return {};
  }
  /// What messages call a source file that belongs to a header.
  static std::string beside(const std::string& shown, const fs::path& source) {
    return fs::path(shown).replace_extension(source.extension()).string();
  }

  bool is_ours(const std::string& key) const {
    if (contains(other_headers, key)) return true;
    std::error_code error;
    for (fs::directory_iterator at(headers_, error), end; !error && at != end; at.increment(error))
      if (at->path().extension() == ".h" && key_of(at->path().filename().string()) == key) return true;
    return false;
  }

  /// The reader's file; empty: there is none. found_as: what messages call it.
  fs::path find(const Include& include, const fs::path& from, const std::string& shown, std::string& found_as) {
    std::vector<fs::path> folders;
    const fs::path own = from.parent_path();
    if (include.quoted) folders.push_back(own);
    folders.insert(folders.end(), sources_.include_folders.begin(), sources_.include_folders.end());
    const bool may_be_own = include.quoted || fs::path(include.name).has_extension();
    if (may_be_own) folders.insert(folders.end(), {own / "include", own / ".." / "include"});
    if (include.quoted) folders.push_back(own / "..");
    std::error_code error;
    for (const fs::path& folder : folders) {
      fs::path file = (folder / include.name).lexically_normal();
      if (!fs::is_regular_file(file, error)) continue;
      const fs::path relative = (fs::path(shown).parent_path() / file.lexically_relative(own)).lexically_normal();
      found_as = (folder == own ? relative : file).string();
      return file;
    }
    // Not for the books' headers: one that lies elsewhere may be another program's, and would tell of another sky.
    if (!include.quoted || is_ours(key_of(include.name))) return {};
    const fs::path elsewhere = project_headers_.find(include.name);
    found_as = elsewhere.string();
    return elsewhere;
  }

  static fs::path identity(const fs::path& file) {
    std::error_code error;
    const fs::path whole = fs::canonical(file, error);
    return error ? file : whole;
  }

  /// Files that the program may read: it runs in another folder.
  void add_data(const std::string& code) {
    constexpr std::size_t longest = 200;
    constexpr std::uintmax_t largest = 64 << 20;
    const fs::path folder = sources_.files.front().parent_path();
    for (const std::string& name : strings_of(code)) {
      const fs::path file = fs::path(name).lexically_normal();
      const bool plain = !name.empty() && name.size() < longest && file.is_relative() && file.has_extension();
      if (!plain || file.extension() == ".h" || file.extension() == ".hpp" || *file.begin() == "..") continue;
      std::error_code error;
      const fs::path whole = folder / file;
      if (!fs::is_regular_file(whole, error) || fs::file_size(whole, error) > largest) continue;
      if (std::find(layout_.data.begin(), layout_.data.end(), file) == layout_.data.end()) layout_.data.push_back(file);
    }
  }

  const ProgramSources& sources_;
  fs::path headers_;
  ProjectHeaders project_headers_;
  ProgramLayout layout_;
  bool uses_books_ = false;
  std::map<fs::path, std::string> copies_;
  std::set<fs::path> seen_;
  std::set<std::string> constants_;
  std::string camera_constructor_, camera_defaults_, namespaces_;
  std::string all_text_, random_text_;  ///< of all files, and of replaced headers that draw random numbers
};

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return out;
}

ProgramLayout lay_out(const ProgramSources& sources, const fs::path& headers) {
  return Layouter(sources, headers).lay_out();
}

}  // namespace tyndall
