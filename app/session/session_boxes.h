/// The display box and the response boxes that a session uses.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/rig/display_box_session.h"
#include "app/rig/rig.h"
#include "app/session/session_commands.h"

namespace overt {

/// Who the box is, if the session goes through one; found before anything is drawn.
struct FoundBox {
    RecordedBox::Use use = RecordedBox::Use::no_mode;
    std::optional<BoxIdentity> identity;
};

/// Switches back what an earlier session left, and finds the box that the protocol's output mode needs.
/// Throws as require_box().
FoundBox find_box(const DisplaySettings& display, const RunOptions& options);

/// The display box as the session has it.
class BoxInUse {
  public:
    /// Switches the box that was found, now that the display is open, and says so.
    BoxInUse(const FoundBox& found, const DisplaySettings& display, Rig& rig);

    /// Null if there is none.
    DisplayPlusPlus* display_box() { return session_ ? &session_->box() : nullptr; }

    const RecordedBox& recorded() const { return recorded_; }

    /// As DisplayBoxSession has them; nothing but the record of its absence without one.
    void write_beginning(SessionStore& store);
    void check(SessionStore& store);
    void leave(SessionStore& store);

  private:
    RecordedBox recorded_;
    std::optional<DisplayBoxSession> session_;
};

/// The protocol's response boxes; null where there are none, or where time is virtual, which `tell` is told.
std::unique_ptr<ResponsePanel> open_button_boxes(const Protocol& protocol, Rig& rig, BoxInUse& box,
                                                 const RunOptions& options,
                                                 const std::function<void(const std::string&)>& tell);

} // namespace overt
