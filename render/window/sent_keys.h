/// Keys that the program sends to a window of its own by way of the X server, to see how long they take.
#pragma once

#include <memory>

namespace overt {

class WindowContext;

/// Has a connection to the server of its own, so that it may be used on another thread than the window, by
/// one at a time.
class SentKeys {
  public:
    /// Throws GraphicsError where the window is not of X, or the server takes no further connection. The
    /// window must outlive this.
    explicit SentKeys(const WindowContext& window);
    ~SentKeys();

    /// The right arrow goes down, or up. Returns once the server has taken it.
    void send(bool down);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace overt
