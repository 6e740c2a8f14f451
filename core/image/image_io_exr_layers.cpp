#ifdef TYNDALL_OPENEXR

#include "core/image/image_io_exr.h"

#include "core/base/text.h"

#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <map>

namespace tyndall {
namespace {

/// The channels of a part whose names have one prefix.
struct ChannelGroup {
  ExrLayer layer;                    ///< without channels where these make up no picture
  std::vector<std::string> endings;  ///< of all its channels: "R", "G", "B", "A"
  std::vector<std::string> names;    ///< by which users can ask for it; the first one is shown to them
  bool deep = false;                 ///< many depths a pixel
  bool main = false;                 ///< the picture of its part
  bool shown() const { return !layer.channels.empty(); }
};

std::string joined(const std::string& a, const std::string& b) { return a.empty() || b.empty() ? a + b : a + "." + b; }

/// The first of `names` that is among the endings; "": none is.
std::string pick(const std::vector<std::string>& endings, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (std::find(endings.begin(), endings.end(), name) != endings.end()) return name;
  return "";
}

/// Finds out what the endings mean, and lists the channels in the order in which they are wanted.
void find_meaning(const std::vector<std::string>& endings, ExrLayer& layer) {
  const auto take = [&](ExrColour colour, const std::vector<std::string>& wanted) {
    if (std::any_of(wanted.begin(), wanted.end(), [](const std::string& name) { return name.empty(); })) return false;
    layer.colour = colour;
    for (const std::string& ending : wanted) layer.channels.push_back(joined(layer.prefix, ending));
    return true;
  };
  const auto has = [&](const char* name) { return pick(endings, {name}); };
  const bool found =
      take(ExrColour::rgb,
           {pick(endings, {"R", "r", "red", "Red", "RED"}), pick(endings, {"G", "g", "green", "Green", "GREEN"}),
            pick(endings, {"B", "b", "blue", "Blue", "BLUE"})}) ||
      take(ExrColour::vector, {pick(endings, {"X", "x"}), pick(endings, {"Y", "y"}), pick(endings, {"Z", "z"})}) ||
      take(ExrColour::luminance_chroma, {has("Y"), has("RY"), has("BY")});
  if (found) return;
  if (has("RY").empty() && has("BY").empty() && take(ExrColour::grey, {has("Y")})) return;
  if (endings.size() == 1) take(ExrColour::grey, {endings[0]});
}

/// Whether these channels are a picture without being asked for by name: not vectors, depths and masks.
bool is_picture(const ChannelGroup& group) {
  const ExrColour colour = group.layer.colour;
  if (!group.shown() || colour == ExrColour::vector) return false;
  return colour != ExrColour::grey || !pick(group.endings, {"Y"}).empty();
}

/// All groups of a part.
std::vector<ChannelGroup> groups_of(const Imf::Header& header, int part, bool several) {
  std::map<std::string, std::vector<std::string>> endings;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    const std::string name = channel.name();
    const std::size_t dot = name.rfind('.');
    if (dot == name.npos) endings[""].push_back(name);
    if (dot != name.npos) endings[name.substr(0, dot)].push_back(name.substr(dot + 1));
  }
  const std::string own = header.hasName() ? header.name() : "";
  std::vector<ChannelGroup> groups;
  for (const auto& [prefix, found] : endings) {
    ChannelGroup& group = groups.emplace_back();
    group.layer.part = part, group.layer.prefix = prefix, group.endings = found;
    group.deep = header.hasType() && Imf::isDeepData(header.type());
    group.main = prefix.empty() || (several && prefix == own);
    find_meaning(found, group.layer);
    const bool named = prefix == own || prefix.starts_with(own + ".");
    group.names = {several && !named ? joined(own, prefix) : prefix};
    if (several && !prefix.empty()) group.names.push_back(prefix);
    if (!prefix.empty()) continue;
    group.names.push_back(own);
    if (header.hasView()) group.names.push_back(header.view());
    if (Imf::hasMultiView(header) && !Imf::multiView(header).empty())
      group.names.push_back(Imf::multiView(header).front());
  }
  return groups;
}

/// `"a", "b" and 7 more`; at most 24 of them.
std::string quoted(std::vector<std::string> names) {
  for (std::string& name : names) name = in_quotes(name);
  return listed(names, 24);
}

/// The names of the layers that can be asked for.
std::vector<std::string> layer_names(const std::vector<ChannelGroup>& groups) {
  std::vector<std::string> names;
  for (const ChannelGroup& group : groups)
    if (group.shown() && !group.deep && !group.names[0].empty()) names.push_back(group.names[0]);
  return names;
}

std::vector<std::string> channel_names(const std::vector<ChannelGroup>& groups) {
  std::vector<std::string> names;
  for (const ChannelGroup& group : groups)
    for (const std::string& ending : group.endings) names.push_back(joined(group.names[0], ending));
  return names;
}

constexpr std::size_t longest_message = 1600;

template <class Error>
[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw Error(file.string() + ": cannot read: " + printable(why, longest_message));
}

/// Why there is no picture in the file unless a layer is named, with all that there is.
[[noreturn]] void fail_without_colour(const std::filesystem::path& file, const std::vector<ChannelGroup>& groups) {
  if (std::all_of(groups.begin(), groups.end(), [](const ChannelGroup& group) { return group.deep; }))
    refuse<ImageFileError>(file, deep_data);
  const std::vector<std::string> layers = layer_names(groups);
  std::string text = "found no channels R, G and B, nor Y, but " + quoted(channel_names(groups));
  if (!layers.empty()) text += "; " + file.filename().string() + ":LAYER takes a layer: " + quoted(layers);
  refuse<ImageFileError>(file, text);
}

[[noreturn]] void fail_unknown(const std::filesystem::path& file, const std::vector<ChannelGroup>& groups,
                               const std::string& name) {
  const std::vector<std::string> layers = layer_names(groups);
  const std::string hint = did_you_mean(name, {layers.begin(), layers.end()});
  if (layers.empty())
    refuse<NoSuchLayer>(file, "found no layer " + in_quotes(name) + ", expected none: it has the channels " +
                                  quoted(channel_names(groups)));
  refuse<NoSuchLayer>(file, "found no layer " + in_quotes(name) + hint + ", expected one of " + quoted(layers));
}

/// The group as the picture that was asked for; refuses what is none.
ExrLayer checked(const std::filesystem::path& file, const ChannelGroup& group, const std::string& name) {
  if (group.deep) refuse<ImageFileError>(file, "layer " + in_quotes(name) + ": " + deep_data);
  if (group.shown()) return group.layer;
  refuse<NoSuchLayer>(file, "found layer " + in_quotes(name) + " with the channels " + quoted(channel_names({group})) +
                                ", expected R, G and B, or X, Y and Z, or Y; a single channel is taken by its name");
}

/// The channel of that whole name as a grey picture.
std::optional<ChannelGroup> single_channel(const std::vector<ChannelGroup>& groups, const std::string& name) {
  for (const ChannelGroup& group : groups)
    for (const std::string& ending : group.endings)
      for (const std::string& before : {group.names[0], group.layer.prefix}) {
        if (joined(before, ending) != name) continue;
        ChannelGroup single = group;
        single.layer.colour = ExrColour::grey, single.layer.channels = {joined(group.layer.prefix, ending)};
        return single;
      }
  return {};
}

}  // namespace

ExrLayer find_exr_layer(const std::filesystem::path& file, const Imf::MultiPartInputFile& exr,
                        const std::optional<std::string>& name) {
  std::vector<ChannelGroup> groups;
  for (int part = 0; part < exr.parts(); ++part)
    for (ChannelGroup& group : groups_of(exr.header(part), part, exr.parts() > 1)) groups.push_back(std::move(group));
  if (!name) {
    for (const ChannelGroup& group : groups)
      if (group.main && !group.deep && is_picture(group)) return group.layer;
    fail_without_colour(file, groups);
  }
  if (name->empty()) fail_unknown(file, groups, *name);
  for (const bool first_name : {true, false})
    for (const ChannelGroup& group : groups) {
      const auto end = first_name ? group.names.begin() + 1 : group.names.end();
      if (std::find(group.names.begin(), end, *name) != end) return checked(file, group, *name);
    }
  if (const auto single = single_channel(groups, *name)) return checked(file, *single, *name);
  fail_unknown(file, groups, *name);
}

}  // namespace tyndall

#endif
