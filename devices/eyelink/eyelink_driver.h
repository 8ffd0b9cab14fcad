/// An SR Research EyeLink 1000, 1000 Plus or later, through the vendor's library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/eyelink/eyelink_items.h"
#include "devices/eyelink/eyelink_library.h"
#include "devices/eyelink/eyelink_words.h"
#include "devices/eyelink/left_on_host.h"
#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"

namespace overt {

/// Gaze is in pixels of the screen as set-up showed its targets there. Its time is that of the host, to the
/// half millisecond at 2000 Hz. Its own recording goes on beside, into a file on the host that finish()
/// fetches.
class EyelinkDriver final : public TrackerDriver {
  public:
    /// Loads the library, see there. `clock` must go by itself and outlive this.
    EyelinkDriver(EyelinkSettings settings, Clock& clock);
    ~EyelinkDriver() override;
    EyelinkDriver(const EyelinkDriver&) = delete;
    EyelinkDriver& operator=(const EyelinkDriver&) = delete;

    /// The rate and eyes that the host offers nearest to the wish; see eyelink_grant(). After a lost
    /// connection the data go on in another file.
    TrackerDescription connect(const TrackerWish& wish) override;
    bool tells_events() const noexcept override { return true; }
    bool calibrates_itself() const noexcept override { return !settings_.is_dummy; }

    /// The tracker's own dialogue, until the operator leaves it there or by Esc.
    SetupOutcome set_up(SetupScreen& setup_screen) override;

    /// The tracker's own check, accepted at its host. Esc there: set-up is wanted. Where the tracker tells no
    /// number, drift is measured from samples.
    std::optional<DriftOutcome> drift_check(ScreenPoint target) override;

    /// Throws DeviceError also if the host records at another rate or another eye than it agreed to.
    void start() override;
    void stop() noexcept override;

    /// An operator who ends the recording at the host has the trial repeated or skipped or the session
    /// aborted, as chosen there. A second without any sample, or a link that the library reports broken, is a
    /// lost tracker.
    RecordingState read(TrackerItemSink& sink, SessionTime deadline) noexcept override;
    void send(const TrackerMark& mark) noexcept override;

    /// By the library's running estimate of the host's clock, which jitters by some 50 us, taken as certain
    /// to 0.25 ms; from older libraries by an exchange, in whole milliseconds.
    std::optional<ClockPair> read_clocks() noexcept override;
    void belongs_in(const std::string& folder) noexcept override;
    std::vector<std::string> finish(const std::string& folder,
                                    const EyeTracker::FileProgress& progress) override;

    /// Connects, and fetches what earlier sessions left on this host into the folders where it belongs. Gives
    /// a sentence for each file, as finish() does. Throws DeviceError if the host cannot be reached,
    /// RecordError if the note of them cannot be read or written.
    std::vector<std::string> fetch_left_files(const EyeTracker::FileProgress& progress);

  private:
    /// Of earlier sessions, on this host.
    std::vector<LeftOnHost> left_files() const;
    void open_connection();
    void configure(const TrackerWish& wish);
    /// Notes what the host has otherwise than it was told.
    void read_back(const std::vector<EyelinkCommand>& commands);
    std::string ask(const char* variable) const;
    std::string sentence_of_calibration() const;
    bool is_recording_as_agreed(std::string& problem);
    std::optional<ClockPair> exchange_times() const noexcept;
    /// Whether it has come; if not, it is noted that it stays on the host.
    bool fetch(const std::string& name, const std::filesystem::path& folder,
               const EyeTracker::FileProgress& progress, std::vector<std::string>& said);
    void note_left(const std::string& name, const std::filesystem::path& folder,
                   std::vector<std::string>& said) noexcept;
    void forget_left(const std::string& name, const std::filesystem::path& folder,
                     std::vector<std::string>& said) noexcept;
    void close() noexcept;

    EyelinkSettings settings_;
    Clock* clock_;
    EyelinkLibrary library_;
    TrackerDescription description_;
    std::string differences_; ///< between what the host was told and what it has
    EyelinkGrant grant_;
    bool is_open_ = false, is_file_open_ = false, is_recording_ = false;
    std::vector<std::string> files_; ///< on the host, without ".edf"
    std::string folder_;             ///< where they belong; empty while that is not told
    std::optional<RecordingState> ended_at_start_;
    std::optional<EyelinkDecoder> decoder_;
    SessionTime last_arrival_, last_burst_;
    int marks_in_burst_ = 0;
    EyelinkItemBytes item_{};
};

} // namespace overt
