#include "app/rig/rig.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/own_folders.h"
#include "app/cli/this_program.h"
#include "app/rig/response_devices.h"
#include "app/rig/tracker_devices.h"
#include "app/rig/video_check.h"
#include "devices/simulated/faulty_tracker.h"
#include "devices/simulated/operator_script.h"
#include "devices/simulated/simulated_keys.h"
#include "devices/simulated/simulated_observer.h"
#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "render/vblank/timing_check.h"

namespace overt {

namespace {

std::vector<ScriptedOperatorKey> read_operator_keys(const RigRequest& request,
                                                    const OperatorSettings& settings) {
    if (!request.operator_keys.empty() && !request.simulate_observer)
        throw InputError("--simulate-operator is for sessions with --simulate-observer");
    std::vector<ScriptedOperatorKey> keys;
    for (const std::string& key : request.operator_keys)
        keys.push_back(read_operator_key(key, static_cast<int>(settings.skip_reasons.size())));
    return keys;
}

DisplayRequest display_of(const Protocol& protocol, const RigRequest& request) {
    if (!wants_window(request.context) && !request.simulate_observer)
        throw InputError(
            "without a window no observer can answer: give --simulate-observer SEED, or a display");
    const DisplaySettings& display = protocol.display;
    return {.context = request.context,
            .size_px = {display.width_px, display.height_px},
            .title = "overt: " + protocol.name,
            .refresh_hz = display.refresh_hz,
            .bits_per_channel = row_of(display.output).framebuffer_bits,
            .virtual_time = request.virtual_time,
            .windowed = request.windowed,
            .monitor = request.monitor.empty() ? display.monitor : request.monitor,
            .has_two_eyes = protocol.stereo.kind == StereoKind::frame_sequential,
            .finds_blanks = true};
}

std::vector<ScreenFinding> examine_screen(const WindowContext& window, const Protocol& protocol) {
    std::vector<ScreenFinding> findings = judge_screen(facts_of(window), protocol.display);
    refuse_unfit_screen(findings);
    return findings;
}

/// A session may not say "0 missed" of refreshes that nobody saw.
void refuse_doubtful_times(const std::vector<std::string>& doubts) {
    if (!doubts.empty())
        throw InputError(fmt::format(
            "the protocol's [display] timing = \"proven\", but nothing proves when this window's pictures "
            "are lit, and at which refresh:\n  {}\nUse a screen whose driver tells its vertical blanks "
            "(`overt doctor --window` "
            "measures it, docs/vblank_sources.md says what is needed), without another screen's or a "
            "compositor's "
            "refreshes. For a trial run write timing = \"unproven\" under [display]: the record, its exports "
            "and its reports then say so. Nothing was recorded.",
            fmt::join(doubts, "\n  ")));
}

} // namespace

Rig::Rig(const Protocol& protocol, std::span<const Object> objects, const RigRequest& request,
         const std::filesystem::path& cache)
    : protocol_(&protocol), objects_(objects), request_(request),
      operator_keys_(read_operator_keys(request, protocol.operators)),
      display_(display_of(protocol, request)),
      screen_findings_(display_.is_real() ? examine_screen(*display_.window(), protocol)
                                          : std::vector<ScreenFinding>()),
      library_(display_.context(), protocol, objects, cache),
      areas_(protocol, objects, library_.cache().poses()),
      points_(protocol, objects, library_.cache().poses()) {
    if (!display_.is_real())
        return;
    const std::vector<ScreenFinding>& quiet = quiet_desktop_.emplace(display_.window()->native()).findings();
    screen_findings_.insert(screen_findings_.end(), quiet.begin(), quiet.end());
}

Rig::~Rig() = default;

std::optional<MonitorInfo> Rig::monitor() const {
    return is_on_a_real_screen() ? std::optional(display_.window()->monitor()) : std::nullopt;
}

std::string Rig::timing_word() const {
    return is_on_a_real_screen() ? std::string(name_of(protocol_->display.timing)) : "none";
}

bool Rig::maps_are_live() const {
    // Software takes a tenth of a second for a map: far longer than a refresh.
    // Live maps are of the one picture that is shown.
    return protocol_->slots.size() == 1 && !protocol_->stereo.is_on() &&
           (request_.maps == MapTime::live ||
            (request_.maps == MapTime::automatic && !context().description().is_software));
}

std::vector<PagePresenter*> Rig::page_presenters() {
    if (stereo_)
        return {&stereo_->of(Eye::left), &stereo_->of(Eye::right)};
    return {presenter_.get()};
}

std::vector<PresentationListener*> Rig::listeners() {
    std::vector<PresentationListener*> all{observer_.get()};
    if (live_maps_)
        all.push_back(live_maps_.get());
    if (VirtualRefresh* refresh = display_.virtual_refresh())
        all.push_back(refresh);
    return all;
}

void Rig::open(SimulatedFaults faults, SessionTime start) {
    if (display_.is_real() && !faults.is_clean())
        throw InputError("faults are simulated where time is: give --virtual-time, or --context osmesa");
    if (display_.is_real() && !request_.draws_stimuli)
        throw InputError("--no-pictures is for sessions that nobody sees: give --virtual-time, or --context "
                         "osmesa");
    display_.start(faults, start);
    const ScreenGeometry geometry = screen_geometry_of(*protocol_);
    if (!request_.draws_stimuli)
        undrawn_ = std::make_unique<UndrawnFrames>(library_, *protocol_);
    const FrameSource& frames = undrawn_ ? static_cast<const FrameSource&>(*undrawn_) : library_;
    if (protocol_->stereo.is_on())
        stereo_ =
            std::make_unique<StereoPresenter>(display_.context(), display_.surface(), frames, *protocol_);
    else
        presenter_ =
            std::make_unique<PagePresenter>(display_.context(), display_.surface(), frames, geometry,
                                            protocol_->display, protocol_->screens, slot_places(*protocol_));
    if (maps_are_live())
        live_maps_ =
            std::make_unique<LiveMaps>(display_.context(), *protocol_, objects_, library_.cache().poses());
    simulated_answers_ = std::make_unique<SimulatedAnswers>(*protocol_, request_.seed);
    observer_ = std::make_unique<SimulatedObserver>(make_observed_scene(*protocol_, objects_, geometry),
                                                    request_.seed);
    observer_->let_answers_guide(
        [this](const Trial& lit) { return simulated_answers_->favour_of(lit, observer_->scene().areas); });
    MadeTracker made = make_tracker({.protocol = *protocol_,
                                     .clock = clock(),
                                     .observer = *observer_,
                                     .seed = request_.seed,
                                     .file_name = request_.observer,
                                     .faults = std::move(faults.tracker),
                                     .notes = state_folder()},
                                    request_.virtual_time);
    tracker_ = std::move(made.tracker);
    faulty_tracker_ = made.faulty;
    open_further_trackers();
    panels_ = make_response_devices({*protocol_, clock(), *observer_, display_.window(),
                                     request_.simulate_observer, operator_keys_, simulated_answers_.get()});
    if (!is_on_a_real_screen())
        return;
    display_.window()->hold_still();
    screen_watch_.emplace(display_.window()->native());
}

void Rig::open_further_trackers() {
    for (std::size_t i = 0; i < protocol_->further_trackers.size(); ++i) {
        const std::string& id = protocol_->further_trackers[i].id;
        Further& further =
            further_trackers_.emplace_back(Further{id, protocol_of_further(*protocol_, i), nullptr});
        // Simulated trackers err independently of each other.
        RandomStream seeds(request_.seed, "further tracker " + id);
        const std::uint64_t high = seeds.next_bits(), seed = high << 32U | seeds.next_bits();
        further.tracker = make_tracker({.protocol = further.protocol,
                                        .clock = clock(),
                                        .observer = *observer_,
                                        .seed = seed,
                                        .file_name = id,
                                        .notes = state_folder()},
                                       request_.virtual_time)
                              .tracker;
    }
}

std::vector<StruckFault> Rig::take_struck_faults() {
    std::vector<StruckFault> struck;
    if (const VirtualRefresh* display = display_.virtual_refresh())
        for (const DisplayFault& fault : display->struck())
            struck.push_back(
                {false, fault.kind == DisplayFault::Kind::skip
                            ? fmt::format("skip of {} at refresh {}", fault.refreshes, fault.refresh)
                            : fmt::format("{} by {:.3f} ms at refresh {}", name_of(fault.kind),
                                          fault.amount_ms, fault.refresh)});
    if (faulty_tracker_)
        for (std::string& fault : faulty_tracker_->take_struck())
            struck.push_back({true, std::move(fault)});
    return struck;
}

AnswerEquipment Rig::answer_equipment() const {
    return {protocol_->answers, display_.clock(), request_.simulate_observer ? observer_.get() : nullptr,
            request_.seed};
}

std::vector<std::string> Rig::closing_warnings() const {
    std::vector<std::string> warnings;
    for (const std::unique_ptr<ResponsePanel>& panel : panels_)
        for (std::string& warning : panel->closing_warnings())
            warnings.push_back(std::move(warning));
    return warnings;
}

std::vector<ScreenFinding> Rig::check_timing(double seconds,
                                             const std::function<void(int done, int total)>& progress) {
    OVERT_EXPECTS(is_on_a_real_screen() && display_.window_display());
    const TimingFacts facts =
        measure_timing(*display_.window(), *display_.window_display(), clock(), seconds, progress);
    std::vector<ScreenFinding> findings = judge_timing(facts, protocol_->display.refresh_hz, "the protocol");
    if (protocol_->display.timing == TimingClaim::proven)
        refuse_doubtful_times(doubts_about_times(facts));
    else
        findings = without_claim(std::move(findings));
    refuse_unfit_screen(findings);
    screen_findings_.insert(screen_findings_.end(), findings.begin(), findings.end());
    return findings;
}

const ScreenFinding& Rig::check_video(const BoxIdentity& box) {
    OVERT_EXPECTS(is_on_a_real_screen());
    screen_findings_.push_back(
        require_video_check(read_video_checks(video_check_file()),
                            video_path(box, context().description(), display_.window()->monitor()),
                            protocol_->display.video_check_days, utc_now()));
    return screen_findings_.back();
}

} // namespace overt
