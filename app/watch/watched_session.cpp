#include "app/watch/watched_session.h"

namespace overt {

namespace {

constexpr std::chrono::milliseconds long_silence{3000};
constexpr std::size_t most_kept_events = 200;
/// A fifth of a second of one eye.
constexpr std::size_t most_kept_gaze = 12;

} // namespace

bool WatchedSession::read(std::chrono::milliseconds wait) {
    const bool goes_on = client_.read(wait);
    news_ = client_.take_events();
    for (const ViewedEvent& event : news_)
        events_.push_back(event);
    while (events_.size() > most_kept_events)
        events_.pop_front();
    for (const ViewedGaze& one : client_.take_gaze())
        gaze_.push_back(one);
    // Gaze is told while a trial is recorded; afterwards it is old.
    if (client_.view().pose < 0)
        gaze_.clear();
    while (gaze_.size() > most_kept_gaze)
        gaze_.pop_front();
    return goes_on;
}

ViewText WatchedSession::text() {
    return {client_.facts(),
            client_.view(),
            events_,
            gaze_,
            pictures_.of(client_.facts(), client_.view()),
            client_.silence() > long_silence};
}

} // namespace overt
