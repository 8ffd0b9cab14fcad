/// The display box of a session: whether one is needed, the way into the protocol's mode and out of it, and
/// its clock.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "devices/display_box/display_plus_plus.h"
#include "experiment/protocol/protocol.h"
#include "experiment/record/recorded_box.h"
#include "experiment/record/write/session_store.h"
#include "render/presenter/page_presenter.h"

namespace overt {

/// What a session does about a box.
struct BoxPlan {
    RecordedBox::Use use = RecordedBox::Use::no_mode;
    std::optional<std::string> port; ///< that the protocol names
};

/// A box is needed where mono++, color++ or bits++ are shown on a real screen in real time, unless the
/// protocol says that there is none.
BoxPlan plan_box(const DisplaySettings& display, bool in_window, bool virtual_time);

/// The mode of the box that reads an output; only for those with T-Lock.
BoxMode box_mode_of(OutputMode output);

/// Asks who is there, and leaves it as it was. Throws InputError if no box answers, which says how to go on.
BoxIdentity require_box(const BoxPlan& plan);

/// Switches a box back that a run which was killed has left in another mode. What was done, or why it could
/// not be, goes to standard error; nothing is said where there was nothing to do.
void switch_back_what_was_left();

/// A box that is in the protocol's mode. The destructor switches it back to Bits++.
class DisplayBoxSession {
  public:
    /// Takes the box that require_box() found, switches it to the output's mode, its dithering off and its
    /// gamma table to the linear one, and relates its clock to the session's through clock reset lines that
    /// the presenter shows. Throws DeviceError, or InputError if its video has another rate than the
    /// protocol says. Takes seconds. `clock` and `presenter` must outlive this.
    DisplayBoxSession(const BoxIdentity& identity, const DisplaySettings& display, Clock& clock,
                      PagePresenter& presenter);

    const RecordedBox& recorded() const { return recorded_; }
    /// For a CB6, which is read between what this asks.
    DisplayPlusPlus& box() { return *box_; }

    /// Puts into the record what the constructor did.
    void write_beginning(SessionStore& store);

    /// Reads its clock once more. Between trials only: takes a quarter of a second. Throws DeviceError if the
    /// box is gone or was restarted, as then it is no longer in the mode.
    void check(SessionStore& store);

    /// Reads its clock for the last time, switches back to Bits++ and writes both down, with the fit of its
    /// clock. Throws DeviceError if the box is not there any more.
    void leave(SessionStore& store);

  private:
    void read_clock(SessionStore& store);
    ShownClockReset show_clock_reset(PagePresenter& presenter);

    Clock& clock_;
    double refresh_hz_;
    std::unique_ptr<DisplayPlusPlus> box_;
    RecordedBox recorded_;
    std::vector<BoxClockPair> pairs_;
};

} // namespace overt
