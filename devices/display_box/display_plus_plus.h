/// A Display++ or Bits# by Cambridge Research Systems, over its USB serial line: its identity, which mode it
/// shows, what video it receives, and its clock. docs/display_plus_plus.md says what of this could not be
/// tried on hardware.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/display_box/bits_link.h"
#include "devices/display_box/video_line_check.h"
#include "experiment/box_time.h"

namespace overt {

/// How the box reads the bytes of the video signal.
enum class BoxMode : std::uint8_t {
    bits_plus_plus,  ///< index into a colour table; a desktop can be read
    mono_plus_plus,  ///< 16 bits of grey a pixel
    color_plus_plus, ///< 16 bits a channel, two pixels make one
};
std::string_view name_of(BoxMode mode);

/// The mode that reads an output, by the protocol's word for it: "mono++", "color++" or "bits++".
std::optional<BoxMode> box_mode_called(std::string_view output);

/// What the box says of itself.
struct BoxIdentity {
    std::string port, product, serial_number, firmware_date;
};

struct DisplayPlusPlusSettings {
    BitsTimeouts timeouts;
    /// After a change of mode the box must be back and its rate steady by then. (Others wait 5 s blindly.)
    SessionDuration settle = std::chrono::seconds(10);
    /// Where the note that the box is switched is kept; empty: none is.
    std::filesystem::path record_folder;
};

/// How a change of mode went.
struct ModeSwitch {
    SessionDuration settled_after; ///< from the command to the second of two equal rates
    double rate_hz = 0.0;          ///< of the video signal, as the box measures it
};

/// The instant at which a clock reset took effect lies between these: the beginning of the refresh after the
/// one that showed the reset line.
struct ShownClockReset {
    SessionTime earliest, latest;
};

/// Unless it says otherwise, a function throws DeviceError if the box does not answer in time or answers
/// nonsense, naming port, command and what came. The destructor switches back to Bits++. One thread.
class DisplayPlusPlus {
  public:
    /// Stops a stream that may run and asks who is there. `clock` must outlive this.
    DisplayPlusPlus(std::unique_ptr<ByteTransport> transport, Clock& clock,
                    DisplayPlusPlusSettings settings = {});
    /// As leave(), without throwing: if the box cannot be switched back, the note stays for the next start.
    ~DisplayPlusPlus();
    DisplayPlusPlus(const DisplayPlusPlus&) = delete;
    DisplayPlusPlus& operator=(const DisplayPlusPlus&) = delete;

    const BoxIdentity& identity() const noexcept { return identity_; }

    /// Rate of the video signal as the box measures it, in Hz; 0 if it sees none.
    double video_rate_hz();

    /// Switches and returns when the box answers as itself again and has measured the same video rate twice
    /// (within 0.5 %). The box cannot be asked for its mode, so this shows that it has settled and not which
    /// mode it took: relate_clocks() proves that T-Lock lines are read, a photometer tells the modes apart.
    /// Before any mode but Bits++ and before the status screen the note is written (RecordError).
    ModeSwitch set_mode(BoxMode mode);

    /// The mode last set; nothing before, and after the status screen was called up.
    std::optional<BoxMode> mode() const noexcept { return mode_; }

    /// Switches off that the box dithers over time. No reply exists; success means that the command was
    /// taken.
    void disable_temporal_dithering();

    /// Chooses the gamma table on the box's disk by its file name. Throws InputError for a name that is none.
    /// No reply exists.
    void select_gamma_table(std::string_view file);

    /// The first `pixels` (1 to 3840) pixels of a video line as the box receives them. Leaves the box on its
    /// status screen: set the mode afterwards. `line` as in DrawnLine.
    std::vector<RgbBytes> read_video_line(int line, int pixels);

    /// Has the lines drawn and compares them with what the box receives, each read `repetitions` times.
    /// `draw` shows a still picture, returns when a whole refresh has shown it, and says what should stand in
    /// which lines. Switches to the mode that was set before, if one was.
    VideoLineReport check_video(const std::function<std::vector<DrawnLine>()>& draw, int repetitions = 3);

    void start_status();
    void stop_status();
    /// See BitsLink::poll_status. Allocates and throws nothing.
    std::size_t poll_status(std::span<ArrivedStatus> into) noexcept { return link_.poll_status(into); }
    std::uint64_t lost_samples() const noexcept { return link_.lost_samples(); }

    /// The line to the box is gone, for good.
    bool lost() const noexcept { return link_.lost(); }

    /// Reads both clocks: starts the stream, takes its second sample (the first may be left over) and stops
    /// it. The sample was taken after the command was sent and before it was here. Restarts a stream that
    /// ran; its samples that were not fetched are forgotten.
    BoxClockPair read_clocks();

    /// Sets the box's clock to zero at a known instant and relates it to the session's. `show_reset` shows
    /// the T-Lock line that resets the clock for one refresh. Repeats this until the box's clock is seen to
    /// have restarted, for as long as a mode may take to settle. Throws DeviceError if it never does: then
    /// T-Lock lines do not arrive or the box is in no mode that reads them. Gives all pairs; more of
    /// read_clocks() may be added later for the drift.
    std::vector<BoxClockPair> relate_clocks(const std::function<ShownClockReset()>& show_reset);

    /// Switches to Bits++, asks whether the box is still there, and removes the note. Needs no video signal.
    void restore_desktop();

    /// Leaves the box in the mode it has now: neither leave() nor the destructor switches back, and the note
    /// says that it is meant.
    void keep_mode();

    /// Stops the stream and, if another mode or the status screen was called up, restores the desktop.
    void leave();

  private:
    BoxIdentity ask_identity();
    ModeSwitch settle(SessionTime since);
    void tell_mode(BoxMode mode);
    void note_away(std::string_view mode);

    Clock& clock_;
    DisplayPlusPlusSettings settings_;
    BitsLink link_;
    BoxIdentity identity_;
    std::optional<BoxMode> mode_;
    std::optional<BoxMode> wanted_;  ///< set by set_mode(): what check_video() goes back to
    bool away_from_desktop_ = false; ///< something other than Bits++ was switched to
    std::string noted_;              ///< mode in the note on disk; empty: none was written
    bool streaming_ = false;
};

} // namespace overt
