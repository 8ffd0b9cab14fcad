#include "devices/eyelink/eyelink_driver.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "devices/eyelink/eyelink_setup.h"
#include "devices/tracker/tracker_device.h"
#include "experiment/base/error.h"

namespace overt {
namespace {

using namespace std::chrono_literals;

constexpr SessionDuration answer_patience = 500ms; ///< for a variable of the host
constexpr SessionDuration longest_silence = 1s;    ///< of a recording
constexpr SessionDuration longest_exchange = 10ms;
constexpr SessionDuration estimate_error = 250us;    ///< of the library's estimate of the host's clock
constexpr SessionDuration after_last_sample = 100ms; ///< so that the file has what was shown last
constexpr SessionDuration to_idle = 50ms;
constexpr std::int16_t no_reply = 1000, aborted_by_escape = 27;

/// Trial codes of the library.
std::optional<RecordingState> state_of(std::int16_t code) noexcept {
    switch (code) {
    case 0:
        return RecordingState::running;
    case 1:
        return RecordingState::repeat;
    case 2:
        return RecordingState::skip;
    case 3:
        return RecordingState::abort;
    default:
        return std::nullopt;
    }
}

} // namespace

EyelinkDriver::EyelinkDriver(EyelinkSettings settings, Clock& clock)
    : settings_(std::move(settings)), clock_(&clock), library_(settings_.library) {}

EyelinkDriver::~EyelinkDriver() {
    if (is_recording_)
        stop();
    close();
}

void EyelinkDriver::close() noexcept {
    if (is_open_)
        library_->close_eyelink_connection();
    is_open_ = is_file_open_ = false;
}

void EyelinkDriver::open_connection() {
    std::string address = settings_.address;
    if (library_->set_eyelink_address(address.data()) != 0)
        throw InputError(
            fmt::format("\"{}\" is no network address that the EyeLink's library understands; the host's "
                        "is 100.1.1.1 as it is delivered",
                        settings_.address));
    const std::int16_t opened = library_->open_eyelink_connection(settings_.is_dummy ? 1 : 0);
    if (const auto problem = eyelink_connection_problem(opened, settings_.address))
        throw DeviceError(*problem);
    is_open_ = true;
    const std::int16_t connected = library_->eyelink_is_connected();
    if (connected != (settings_.is_dummy ? -1 : 1)) {
        close();
        throw DeviceError(fmt::format("The EyeLink at {} was reached, but its link is not open (state {}).",
                                      settings_.address, connected));
    }
    std::array<char, 256> version{};
    const std::int16_t make = library_->eyelink_get_tracker_version(version.data());
    version.back() = '\0';
    description_.model = version.data();
    if (!settings_.is_dummy && make < 3) {
        close();
        throw DeviceError(
            fmt::format("The tracker calls itself \"{}\" (kind {}): overt knows the EyeLink 1000 and later.",
                        description_.model, make));
    }
}

std::string EyelinkDriver::ask(const char* variable) const {
    std::string name = variable;
    if (library_->eyelink_read_request(name.data()) != 0)
        return {};
    std::array<char, 1024> reply{};
    const SessionTime until = clock_->now() + answer_patience;
    while (library_->eyelink_read_reply(reply.data()) == no_reply) {
        if (clock_->now() >= until)
            return {};
        clock_->wait_until(clock_->now() + 1ms);
    }
    reply.back() = '\0';
    return reply.data();
}

void EyelinkDriver::configure(const TrackerWish& wish) {
    library_->set_offline_mode();
    clock_->wait_until(clock_->now() + to_idle);
    differences_.clear();
    grant_ = eyelink_grant(eyelink_modes(ask("read_mode_list")), wish);
    const std::vector<EyelinkCommand> commands =
        eyelink_commands(wish, settings_, grant_, eyelink_software_version(description_.model));
    for (const EyelinkCommand& command : commands) {
        const std::int16_t result = library_->eyecmd_printf("%s", command.text.c_str());
        if (result == 0 || !command.is_needed)
            continue;
        std::array<char, 512> said{};
        library_->eyelink_last_message(said.data());
        said.back() = '\0';
        throw DeviceError(fmt::format("The EyeLink refuses the command \"{}\" (error {}{}{}).", command.text,
                                      result, said[0] ? ": " : "", said.data()));
    }
    read_back(commands);
    library_->eyemsg_printf("%s", eyelink_display_coords(wish.screen).c_str());
}

void EyelinkDriver::read_back(const std::vector<EyelinkCommand>& commands) {
    for (const EyelinkCommand& command : commands) {
        if (settings_.is_dummy || !command.is_read_back)
            continue;
        const EyelinkVariable wished = eyelink_variable(command.text);
        const std::string told = ask(std::string(wished.name).c_str());
        if (told.empty())
            return; // hosts that tell one tell all
        if (!eyelink_means_same(wished.value, told))
            differences_ +=
                fmt::format(", its host has {} = {} where {} was asked for", wished.name, told, wished.value);
    }
}

TrackerDescription EyelinkDriver::connect(const TrackerWish& wish) {
    auto opened_at = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    std::string name = eyelink_file_name(wish.file_name, opened_at);
    while (std::ranges::find(files_, name) != files_.end())
        name = eyelink_file_name(wish.file_name, opened_at += std::chrono::seconds(1));
    close();
    is_recording_ = false;
    open_connection();
    std::string file = name + ".EDF";
    if (const std::int16_t opened = library_->open_data_file(file.data()); opened != 0 && !settings_.is_dummy)
        throw DeviceError(fmt::format(
            "The EyeLink's host cannot open the data file {} (error {}): is its disk full?", file, opened));
    is_file_open_ = true;
    files_.push_back(name);
    if (!folder_.empty())
        belongs_in(folder_);
    library_->eyecmd_printf("%s", "add_file_preamble_text 'Recorded by overt'");
    configure(wish);
    description_.name = settings_.is_dummy ? "eyelink without a tracker" : "eyelink";
    description_.model += fmt::format(", its file {}{}", file, differences_);
    if (const std::vector<LeftOnHost> left = left_files(); !left.empty()) {
        description_.model += fmt::format("; still on its host, and brought by overt tracker fetch:");
        for (const LeftOnHost& each : left)
            description_.model += fmt::format(" {}.EDF for {}", each.name, each.folder.string());
    }
    description_.sample_rate_hz = grant_.rate_hz;
    description_.eye = wish.eye;
    description_.both_eyes = grant_.both_eyes;
    return description_;
}

std::string EyelinkDriver::sentence_of_calibration() const {
    std::array<char, 1024> text{};
    library_->eyelink_cal_message(text.data());
    text.back() = '\0';
    return text.data();
}

SetupOutcome EyelinkDriver::set_up(SetupScreen& setup_screen) {
    SetupOutcome outcome;
    outcome.method = "tracker";
    if (settings_.is_dummy)
        return outcome;
    EyelinkSetup setup(library_, &setup_screen, {settings_.target_deg}, *clock_, SessionTime::max());
    library_->do_tracker_setup();
    setup.check();
    if (library_->eyelink_is_connected() != 1)
        throw DeviceError(
            "The connection to the EyeLink was lost during its set-up. Look at the network cable and at "
            "the host.");
    const std::int16_t result = library_->eyelink_cal_result();
    outcome.message = sentence_of_calibration();
    outcome.validation = eyelink_validation(outcome.message);
    if (const std::optional<int> targets = eyelink_targets(outcome.message))
        outcome.method = fmt::format("tracker, {} points", *targets);
    if (setup_screen.is_cancelled() || result == aborted_by_escape) {
        outcome.kind = SetupOutcome::Kind::cancelled;
    } else if (result == 1) {
        outcome.message = fmt::format("The tracker calls the calibration poor. {}", outcome.message);
    } else if (result != 0) {
        outcome.kind = SetupOutcome::Kind::failed;
        if (result == no_reply)
            outcome.message = "Set-up was left without a calibration.";
    }
    return outcome;
}

std::optional<DriftOutcome> EyelinkDriver::drift_check(ScreenPoint target) {
    if (settings_.is_dummy)
        return DriftOutcome{};
    library_->set_offline_mode();
    clock_->wait_until(clock_->now() + to_idle);
    EyelinkSetup setup(library_, nullptr, {settings_.target_deg}, *clock_,
                       clock_->now() + settings_.drift_patience);
    // The target is on the screen already. Set-up is the session's to begin, which has screen and keys for
    // it: with the last argument 1 the library would begin it here, where nobody sees it.
    const std::int16_t result =
        library_->do_drift_correct(static_cast<std::int16_t>(std::lround(target.x_px)),
                                   static_cast<std::int16_t>(std::lround(target.y_px)), 0, 0);
    setup.check();
    if (setup.is_out_of_time())
        return DriftOutcome{};
    if (result == aborted_by_escape)
        return DriftOutcome{DriftOutcome::Kind::set_up_wanted, {}};
    if (result != 0)
        return DriftOutcome{};
    if (const auto error = eyelink_drift(sentence_of_calibration()))
        return DriftOutcome{DriftOutcome::Kind::measured, *error};
    return std::nullopt;
}

bool EyelinkDriver::is_recording_as_agreed(std::string& problem) {
    const auto eyes = eyelink_eyes(library_->eyelink_eye_available());
    if (!eyes) {
        problem = "it says that it measures no eye";
        return false;
    }
    const EyelinkEyes agreed = grant_.both_eyes                ? EyelinkEyes::both
                               : description_.eye == Eye::left ? EyelinkEyes::left
                                                               : EyelinkEyes::right;
    if (*eyes != agreed) {
        constexpr std::array words{"the left eye", "the right eye", "both eyes"};
        problem =
            fmt::format("it measures {} and not {}, as was agreed: choose there, or set [tracker] eye",
                        words[static_cast<std::size_t>(*eyes)], words[static_cast<std::size_t>(agreed)]);
        return false;
    }
    std::int16_t rate = 0, mode = 0, file_filter = 0, link_filter = 0;
    if (library_->eyelink_mode_data &&
        library_->eyelink_mode_data(&rate, &mode, &file_filter, &link_filter) != -1 && rate > 0 &&
        rate != grant_.rate_hz) {
        problem =
            fmt::format("it measures at {} Hz and not at {} Hz, as was agreed: somebody has changed it there",
                        rate, grant_.rate_hz);
        return false;
    }
    decoder_.emplace(*eyes, grant_.rate_hz);
    return true;
}

void EyelinkDriver::start() {
    ended_at_start_.reset();
    if (settings_.is_dummy)
        return;
    library_->set_offline_mode();
    clock_->wait_until(clock_->now() + to_idle);
    library_->eyelink_reset_data(1);
    const std::int16_t started = library_->start_recording(1, 1, 1, 1);
    if (started != 0) {
        ended_at_start_ = state_of(started);
        if (!ended_at_start_)
            throw DeviceError(
                fmt::format("The EyeLink does not begin to record (error {}). Look at its host.", started));
        return;
    }
    is_recording_ = true;
    std::string problem;
    if (library_->eyelink_wait_for_block_start(100, 1, 0) == 0)
        problem = "no samples come over the link";
    else
        is_recording_as_agreed(problem);
    if (!problem.empty()) {
        stop();
        throw DeviceError(fmt::format("The EyeLink does not record as it should: {}.", problem));
    }
    last_arrival_ = clock_->now();
}

void EyelinkDriver::stop() noexcept {
    if (!is_recording_)
        return;
    is_recording_ = false;
    clock_->wait_until(clock_->now() + after_last_sample);
    library_->stop_recording();
    library_->set_offline_mode();
}

RecordingState EyelinkDriver::read(TrackerItemSink& sink, SessionTime deadline) noexcept {
    if (ended_at_start_)
        return *ended_at_start_;
    if (settings_.is_dummy || !decoder_) {
        clock_->wait_until(deadline);
        return RecordingState::running;
    }
    for (;;) {
        bool came = false;
        while (const std::int16_t kind = library_->eyelink_get_next_data(nullptr)) {
            came = true;
            const auto item = static_cast<EyelinkItem>(kind);
            if (item != EyelinkItem::lost_data)
                library_->eyelink_get_float_data(item_.data());
            decoder_->take(item, item_, sink);
            if (item == EyelinkItem::sample)
                last_arrival_ = clock_->now();
        }
        const std::int16_t recording = library_->check_recording();
        if (recording != 0) {
            const auto state = state_of(recording);
            // Without a reason of its own, what the operator chose when the recording was ended there.
            const auto chosen = state ? state : state_of(library_->check_record_exit());
            const bool is_connected = library_->eyelink_is_connected() == 1;
            return is_connected && chosen && *chosen != RecordingState::running ? *chosen
                                                                                : RecordingState::lost;
        }
        const SessionTime now = clock_->now();
        if (library_->eyelink_is_connected() != 1 || now - last_arrival_ > longest_silence)
            return RecordingState::lost;
        if (came || now >= deadline)
            return RecordingState::running;
        clock_->wait_until(std::min(deadline, now + SessionDuration(1ms)));
    }
}

void EyelinkDriver::send(const TrackerMark& mark) noexcept {
    if (!is_open_)
        return;
    std::array<char, 128> room{};
    SessionTime now = clock_->now();
    // The tracker drops messages that come in bursts.
    constexpr int most_in_burst = 4;
    if (now - last_burst_ >= SessionDuration(1ms)) {
        last_burst_ = now;
        marks_in_burst_ = 0;
    } else if (++marks_in_burst_ >= most_in_burst) {
        clock_->wait_until(now + 1ms);
        last_burst_ = now = clock_->now();
        marks_in_burst_ = 0;
    }
    const std::string_view text =
        eyelink_message(mark.text, now - mark.at, std::span(room).first(room.size() - 1));
    room[text.size()] = '\0';
    library_->eyemsg_printf("%s", room.data());
}

std::optional<ClockPair> EyelinkDriver::read_clocks() noexcept {
    if (settings_.is_dummy || !is_open_ || library_->eyelink_is_connected() != 1)
        return std::nullopt;
    if (!library_->eyelink_tracker_double_usec)
        return exchange_times();
    ClockPair pair;
    pair.before = clock_->now() - estimate_error;
    const double us = library_->eyelink_tracker_double_usec();
    pair.after = clock_->now() + estimate_error;
    if (!std::isfinite(us) || !(us > 0.0) || us > 1e17)
        return std::nullopt;
    pair.other = tracker_time(std::llround(us));
    return pair;
}

std::optional<ClockPair> EyelinkDriver::exchange_times() const noexcept {
    ClockPair pair;
    pair.before = clock_->now();
    library_->eyelink_request_time();
    std::uint32_t ms = 0;
    while ((ms = library_->eyelink_read_time()) == 0) {
        if (clock_->now() - pair.before > longest_exchange)
            return std::nullopt;
    }
    // The host told a whole millisecond, in which it was at some instant between the two readings.
    pair.after = clock_->now() + 500us;
    pair.before -= 500us;
    pair.other = tracker_time(std::int64_t{ms} * 1000 + 500);
    return pair;
}

template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("eyelink")>() {
    return {
        .make_driver = [](const TrackerParts& parts) -> std::unique_ptr<TrackerDriver> {
            EyelinkSettings settings;
            settings.is_dummy = parts.protocol.tracker.address == "dummy";
            if (!settings.is_dummy && !parts.protocol.tracker.address.empty())
                settings.address = parts.protocol.tracker.address;
            settings.calibration_points = parts.protocol.calibration.points;
            settings.target_deg = parts.protocol.calibration.target_deg;
            settings.notes = parts.notes;
            return std::make_unique<EyelinkDriver>(settings, parts.clock);
        },
        .can_do =
            "up to 2000 Hz of one eye or 1000 Hz of both, calibrates itself, tells fixations and saccades, "
            "keeps a file of its own",
        .look_for =
            [] {
                EyelinkLibrary();
                return std::string("its library is there");
            }};
}

} // namespace overt
