#include "cell/frames.hpp"

#include <algorithm>
#include <utility>

#include "cell/digest.hpp"
#include "cell/failure.hpp"
#include "protocol/monitor/display.hpp"
#include "protocol/monitor/image.hpp"
#include "protocol/monitor/model.hpp"

namespace xr3 {
namespace {

using monitor::Channel;

// Selections that are remembered for a channel; of more, those of old frames are forgotten.
constexpr std::size_t kMostMade = 64;

}  // namespace

const monitor::Frame* Frames::current(const monitor::Selection& selection) {
  return vital("the frames", [&] { return look_at(selection); });
}

const monitor::Frame* Frames::look_at(const monitor::Selection& selection) {
  Film& film = films_.at(static_cast<std::size_t>(selection.channel));
  look(selection.channel, film);
  if (selection.channel == Channel::kImage && !film.image) return nullptr;
  Made& made = made_for(film, selection);
  if (made.seq != film.seq) make(film, made);
  return &made.frame;
}

void Frames::look(Channel channel, Film& film) {
  if (film.revision == cell_.revision()) return;
  film.revision = cell_.revision();
  const bool is_new = film.seq == 0 || film.epoch != cell_.epoch();
  if (!has_changed(channel, film) && !is_new) return;
  ++film.seq;
  film.epoch = cell_.epoch();
  film.tick = cell_.state().tick;
}

bool Frames::has_changed(Channel channel, Film& film) const {
  if (channel == Channel::kImage) return has_new_image(film);
  if (channel == Channel::kState && is_only_later(film)) return film.tick != cell_.state().tick;
  if (channel == Channel::kModel && is_same_model(film)) return false;
  film.members = members_now(channel);
  std::string text = monitor::text_of(film.members);
  const bool is_other = text != film.text;
  film.text = std::move(text);
  const bool is_later = channel == Channel::kState && film.tick != cell_.state().tick;
  return is_other || is_later;
}

/// Nothing but time has passed since the last look: no text need be made anew.
bool Frames::is_only_later(Film& film) const {
  Snapshot now = cell_.snapshot();
  now.state.tick = 0;
  const bool is_same = film.snapshot == now;
  film.snapshot = std::move(now);
  return is_same;
}

/// The workcell is as it was at the last look; the robot never changes.
bool Frames::is_same_model(Film& film) const {
  ShownModel now{cell_.model_rev(), workcell_now(cell_.model(), cell_.state())};
  const bool is_same = film.model == now;
  film.model = std::move(now);
  return is_same;
}

bool Frames::has_new_image(Film& film) const {
  const ImagePtr before = std::exchange(film.image, cell_.camera_image());
  if (before == film.image) return false;
  return !before || !film.image || *before != *film.image;
}

Json Frames::members_now(Channel channel) const {
  const Model& model = cell_.model();
  if (channel == Channel::kDisplay) return display_json(model, cell_.state());
  if (channel == Channel::kState) return state_json(model, cell_.snapshot());
  Json members = model_json(model, cell_.state(), cell_.model_rev(), "");
  members["hash"] = sha256(members["robot"].dump() + members["workcell"].dump());
  return members;
}

Frames::Made& Frames::made_for(Film& film, const monitor::Selection& selection) const {
  const auto found =
      std::find_if(film.made.begin(), film.made.end(),
                   [&selection](const Made& made) { return made.selection == selection; });
  if (found != film.made.end()) return *found;
  if (film.made.size() >= kMostMade) film.made.clear();
  return film.made.emplace_back(Made{selection, 0, {}});
}

std::string Frames::content_of(const Film& film, const monitor::Selection& selection) {
  if (!film.image && !selection.fields) return film.text;
  if (film.image && !selection.fields) return image_text(*film.image, selection.encoding);
  const Json members = film.image ? image_json(*film.image, selection.encoding) : film.members;
  return monitor::text_of(chosen(members, selection.fields));
}

void Frames::make(const Film& film, Made& made) const {
  const monitor::Selection& selection = made.selection;
  std::string content = content_of(film, selection);
  if (!made.frame.content || *made.frame.content != content)
    made.frame.content = std::make_shared<const std::string>(std::move(content));
  made.seq = made.frame.seq = film.seq;
  made.frame.message = monitor::channel_message(
      selection.channel, {cell_.name(), film.epoch, film.seq, film.tick}, *made.frame.content);
}

}  // namespace xr3
