#include "app/watch/watched_session.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr std::chrono::milliseconds long_silence{3000};
constexpr std::chrono::seconds camera_lasts{2};
constexpr std::size_t most_kept_events = 200;
/// A fifth of a second of one eye.
constexpr std::size_t most_kept_gaze = 50;
constexpr std::size_t most_kept_objects = 8;

ViewedPicture grey_of(const ViewedCamera& camera) {
    ViewedPicture picture{camera.width_px, camera.height_px, {}};
    for (std::size_t i = 0; i + 2 < camera.rgb.size(); i += 3) {
        int sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += std::to_integer<int>(camera.rgb[i + k]);
        picture.lightness.push_back(static_cast<float>(sum) / (3.0f * 255.0f));
    }
    return picture;
}

} // namespace

const ViewedStimulus* WatchedSession::shown_at(int shown) const {
    const std::vector<ViewedStimulus>& all = client_.view().shown;
    return shown >= 0 && static_cast<std::size_t>(shown) < all.size() ? &all[static_cast<std::size_t>(shown)]
                                                                      : nullptr;
}

std::shared_ptr<const WatchedObject> WatchedSession::object_of(int shown) const {
    const ViewedStimulus* const stimulus = shown_at(shown);
    const auto found = stimulus ? objects_.find({stimulus->object, stimulus->seen_in}) : objects_.end();
    return found == objects_.end() ? nullptr : found->second;
}

std::string WatchedSession::slot_of(int shown) const {
    const ViewedStimulus* const stimulus = shown_at(shown);
    const std::vector<ViewedSlot>& slots = client_.facts().slots;
    const auto slot = static_cast<std::size_t>(stimulus ? stimulus->slot : 0);
    return slots.size() > 1 && slot < slots.size() ? slots[slot].id : std::string();
}

/// A view without a surface is still a view: what cannot be read is left out. Objects are read one after the
/// other, those of the trial under way; what was read before is kept while there is not too much of it.
void WatchedSession::read_objects() {
    if (reading_.valid()) {
        if (reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        objects_[being_read_] = reading_.get();
    }
    for (const ViewedStimulus& shown : client_.view().shown) {
        const SeenObject wanted{shown.object, shown.seen_in};
        if (shown.object.empty() || objects_.contains(wanted))
            continue;
        if (objects_.size() >= most_kept_objects)
            std::erase_if(objects_, [&](const auto& kept) {
                return std::ranges::none_of(client_.view().shown, [&](const ViewedStimulus& one) {
                    return kept.first == SeenObject{one.object, one.seen_in};
                });
            });
        being_read_ = wanted;
        reading_ = std::async(std::launch::async,
                              [folder = std::filesystem::path(client_.facts().folder),
                               object = wanted]() -> std::shared_ptr<const WatchedObject> {
                                  try {
                                      return std::make_shared<const WatchedObject>(folder, object.first,
                                                                                   object.second);
                                  } catch (const Error&) {
                                      return nullptr;
                                  }
                              });
        return;
    }
}

bool WatchedSession::read(std::chrono::milliseconds wait) {
    const bool goes_on = client_.read(wait);
    read_objects();
    news_ = client_.take_events();
    for (const ViewedEvent& event : news_)
        events_.push_back(event);
    while (events_.size() > most_kept_events)
        events_.pop_front();
    new_gaze_.clear();
    if (!shown_at(looked_at_))
        looked_at_ = 0;
    for (const ViewedGaze& one : client_.take_gaze()) {
        gaze_.push_back(one);
        const bool is_of_trial = one.place && one.trial == client_.view().trial;
        if (is_of_trial && shown_at(one.shown))
            looked_at_ = one.shown;
        new_gaze_.push_back({one, is_of_trial ? met_by(one) : std::nullopt});
        last_gaze_ = new_gaze_.back();
        tally(*last_gaze_);
    }
    // Gaze is told while a trial is recorded; afterwards it is old.
    if (!client_.view().is_lit()) {
        gaze_.clear();
        last_gaze_.reset();
    }
    while (gaze_.size() > most_kept_gaze)
        gaze_.pop_front();
    const auto now = std::chrono::steady_clock::now();
    if (std::optional<ViewedCamera> camera = client_.take_camera()) {
        camera_picture_ = grey_of(*camera);
        camera_ = std::move(camera);
        camera_came_ = now;
    }
    if (camera_ && now - camera_came_ > camera_lasts)
        camera_.reset();
    return goes_on;
}

std::optional<RayHit> WatchedSession::met_by(const ViewedGaze& gaze) const {
    const ViewedStimulus* const stimulus = shown_at(gaze.shown);
    const std::shared_ptr<const WatchedObject> object = object_of(gaze.shown);
    if (!stimulus || !object || !gaze.place)
        return std::nullopt;
    const std::vector<ViewedSlot>& slots = client_.facts().slots;
    const auto slot = static_cast<std::size_t>(stimulus->slot);
    return slot < slots.size()
               ? object->met_at(*gaze.place, gaze.pose, {slots[slot].left_px, slots[slot].top_px})
               : object->met_at(*gaze.place, gaze.pose);
}

void WatchedSession::tally(const GazeOnSurface& gaze) {
    has_right_ = has_right_ || gaze.gaze.is_right;
    if (!gaze.hit || gaze.gaze.is_right != has_right_)
        return;
    const std::shared_ptr<const WatchedObject> object = object_of(gaze.gaze.shown);
    const Mesh& mesh = object->mesh();
    const auto at = tallies_
                        .try_emplace(object->id() + "/" + slot_of(gaze.gaze.shown),
                                     std::span<const std::string>(mesh.part_names))
                        .first;
    at->second.add(gaze.gaze.trial, mesh.triangle_parts[gaze.hit->triangle], 1.0); // points come evenly
}

std::string WatchedSession::areas_text() const {
    const std::shared_ptr<const WatchedObject> object = this->object();
    const std::string slot = slot_of(looked_at_);
    const auto found = object ? tallies_.find(object->id() + "/" + slot) : tallies_.end();
    if (found == tallies_.end())
        return {};
    const std::string session = words_of(found->second.shares(false)),
                      trial = words_of(found->second.shares(true));
    if (session.empty())
        return session;
    return fmt::format("{}{}; this trial {}", slot.empty() ? "" : slot + ": ", session, trial);
}

std::string WatchedSession::surface_text() const {
    const std::shared_ptr<const WatchedObject> object = this->object();
    if (!last_gaze_ || !last_gaze_->gaze.place || !object)
        return {};
    const std::string slot = slot_of(last_gaze_->gaze.shown);
    if (!last_gaze_->hit)
        return slot.empty() ? "beside the object" : slot + ": beside the object";
    const glm::dvec3& at = last_gaze_->hit->position;
    return fmt::format(
        "{}{}, at {:.1f}, {:.1f}, {:.1f}{}", slot.empty() ? "" : fmt::format("{}: {}, ", slot, object->id()),
        object->part_of(*last_gaze_->hit), at.x, at.y, at.z, object->unit() == "mm" ? " mm" : "");
}

std::vector<ViewedPicture> WatchedSession::pictures() {
    const std::vector<ViewedStimulus>& shown = client_.view().shown;
    pictures_.resize(shown.size());
    std::vector<ViewedPicture> all;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const auto slot = static_cast<std::size_t>(shown[i].slot);
        if (shown[i].pose < 0 || slot >= client_.facts().slots.size())
            all.emplace_back();
        else
            all.push_back(pictures_[i].of(client_.facts(), client_.facts().slots[slot], shown[i]));
    }
    return all;
}

ViewText WatchedSession::text() {
    const auto at = static_cast<std::size_t>(looked_at_);
    if (const std::vector<ViewedPicture> all = pictures(); at < all.size())
        picture_ = all[at];
    return {client_.facts(),
            client_.view(),
            events_,
            gaze_,
            camera_ ? camera_picture_ : picture_,
            client_.silence() > long_silence,
            surface_text(),
            areas_text(),
            camera_.has_value(),
            looked_at_};
}

} // namespace overt
