#include "app/watch/watched_session.h"

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr std::chrono::milliseconds long_silence{3000};
constexpr std::chrono::seconds camera_lasts{2};
constexpr std::size_t most_kept_events = 200;
/// A fifth of a second of one eye.
constexpr std::size_t most_kept_gaze = 50;

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

/// A view without a surface is still a view: what cannot be read is left out.
void WatchedSession::read_object() {
    const SeenObject now{client_.view().object, client_.view().seen_in};
    if (reading_.valid() && reading_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        object_ = reading_.get();
    if (now == wanted_ || now.id.empty() || reading_.valid())
        return;
    wanted_ = now;
    object_.reset();
    reading_ = std::async(std::launch::async,
                          [folder = std::filesystem::path(client_.facts().folder),
                           object = now]() -> std::shared_ptr<const WatchedObject> {
                              try {
                                  return std::make_shared<const WatchedObject>(folder, object.id, object.view);
                              } catch (const Error&) {
                                  return nullptr;
                              }
                          });
}

bool WatchedSession::read(std::chrono::milliseconds wait) {
    const bool goes_on = client_.read(wait);
    read_object();
    news_ = client_.take_events();
    for (const ViewedEvent& event : news_)
        events_.push_back(event);
    while (events_.size() > most_kept_events)
        events_.pop_front();
    new_gaze_.clear();
    const bool is_known = object_ && object_->id() == client_.view().object &&
                          object_->view() == client_.view().seen_in;
    for (const ViewedGaze& one : client_.take_gaze()) {
        gaze_.push_back(one);
        new_gaze_.push_back({one, is_known && one.place && one.trial == client_.view().trial
                                      ? object_->met_at(*one.place, one.pose)
                                      : std::nullopt});
        last_gaze_ = new_gaze_.back();
        tally(*last_gaze_);
    }
    // Gaze is told while a trial is recorded; afterwards it is old.
    if (client_.view().pose < 0) {
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

void WatchedSession::tally(const GazeOnSurface& gaze) {
    has_right_ = has_right_ || gaze.gaze.is_right;
    if (!gaze.hit || gaze.gaze.is_right != has_right_)
        return;
    const Mesh& mesh = object_->mesh();
    const auto at = tallies_.try_emplace(object_->id(), std::span<const std::string>(mesh.part_names)).first;
    at->second.add(gaze.gaze.trial, mesh.triangle_parts[gaze.hit->triangle], 1.0); // points come evenly
}

std::string WatchedSession::areas_text() const {
    const auto found = object_ ? tallies_.find(object_->id()) : tallies_.end();
    if (found == tallies_.end())
        return {};
    const std::string session = words_of(found->second.shares(false)),
                      trial = words_of(found->second.shares(true));
    return session.empty() ? session : fmt::format("{}; this trial {}", session, trial);
}

std::string WatchedSession::surface_text() const {
    if (!last_gaze_ || !last_gaze_->gaze.place || !object_)
        return {};
    if (!last_gaze_->hit)
        return "beside the object";
    const glm::dvec3& at = last_gaze_->hit->position;
    return fmt::format("{}, at {:.1f}, {:.1f}, {:.1f}{}", object_->part_of(*last_gaze_->hit), at.x, at.y,
                       at.z, object_->unit() == "mm" ? " mm" : "");
}

ViewText WatchedSession::text() {
    return {client_.facts(),
            client_.view(),
            events_,
            gaze_,
            camera_ ? camera_picture_ : pictures_.of(client_.facts(), client_.view()),
            client_.silence() > long_silence,
            surface_text(),
            areas_text(),
            camera_.has_value()};
}

} // namespace overt
