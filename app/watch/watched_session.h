/// A session that is watched: what has come from it, kept as long as it is shown.
#pragma once

#include <chrono>
#include <deque>

#include "app/watch/viewed_pictures.h"
#include "devices/operator/operator_client.h"
#include "experiment/watch/view_text.h"

namespace overt {

/// For one thread.
class WatchedSession {
  public:
    /// `client` must outlive this.
    explicit WatchedSession(OperatorClient& client) : client_(client) {}

    /// Takes what has come, waiting so long for it; false once there is nothing more to come.
    bool read(std::chrono::milliseconds wait);

    /// All that is shown; valid until the next read().
    ViewText text();
    /// Events that the last read() brought.
    const std::deque<ViewedEvent>& news() const { return news_; }

  private:
    OperatorClient& client_;
    std::deque<ViewedEvent> news_, events_;
    std::deque<ViewedGaze> gaze_;
    ViewedPictures pictures_;
};

} // namespace overt
