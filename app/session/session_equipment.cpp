#include "app/session/session_equipment.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/inputs/prepared_stimuli.h"
#include "app/session/session_circumstances.h"
#include "app/session/session_messages.h"
#include "app/session/session_room.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

RigRequest rig_request(const RunOptions& options, const SessionPlan& plan) {
    return {.context = options.context,
            .virtual_time = options.virtual_time,
            .windowed = options.windowed,
            .simulate_observer = options.simulate_observer.has_value(),
            .seed = seed_of_simulated(options, plan),
            .maps = options.maps,
            .monitor = options.monitor,
            .operator_keys = options.operator_keys,
            .draws_stimuli = options.draws_stimuli,
            .observer = plan.schedule.observer.label};
}

} // namespace

SessionEquipment::SessionEquipment(const Experiment& experiment, const RunOptions& options,
                                   const SessionPlan& plan, const std::filesystem::path& cache)
    : found_box_(find_box(experiment.protocol.display, options)),
      rig_(experiment.protocol, experiment.objects, rig_request(options, plan), cache) {
    prepare(experiment, options, plan);
    open(experiment.protocol, options, plan);
}

void SessionEquipment::prepare(const Experiment& experiment, const RunOptions& options,
                               const SessionPlan& plan) {
    const Protocol& protocol = experiment.protocol;
    if (rig_.is_on_a_real_screen() && options.refresh_check_s <= 0.0 &&
        protocol.display.timing == TimingClaim::proven)
        throw InputError(
            "--refresh-check 0 measures nothing, and so proves no times, as the protocol's [display] "
            "timing = \"proven\" asks: leave the option out, or write timing = \"unproven\" "
            "under [display]; the record then says so");
    if (found_box_.identity)
        rig_.check_video(*found_box_.identity);
    say_before(protocol, plan.schedule, rig_.context().description(), options);
    say_risks(rig_.screen_findings());
    interruption_.emplace();
    const MapsNow maps = rig_.maps_are_live() ? MapsNow::drawn_live : MapsNow::made;
    const auto meanwhile = [this] { rig_.pump_events(); };
    if (options.draws_stimuli)
        prepare_stimuli(rig_.library(), maps,
                        options.quality.value_or(protocol.bake.least(!options.simulate_observer)), meanwhile);
    else
        prepare_maps_alone(rig_.library(), maps, protocol, meanwhile);
    say_frames(rig_.library(), !options.simulate_observer);
    require_room(experiment, plan, rig_.library(), !rig_.maps_are_live(), options.sessions);
}

void SessionEquipment::open(const Protocol& protocol, const RunOptions& options, const SessionPlan& plan) {
    rig_.open(plan.faults, plan.resumed ? plan.resumed->clock_start : SessionTime());
    if (rig_.is_on_a_real_screen() && options.refresh_check_s > 0.0)
        check_timing(rig_, options.refresh_check_s);
    rig_.leading_presenter().close_on(Interruption::requested());
    box_.emplace(found_box_, protocol.display, rig_);
    const auto tell = [](const std::string& sentence) { fmt::print(stderr, "{}\n", sentence); };
    buttons_ = open_button_boxes(protocol, rig_, *box_, options, tell);
    markers_.emplace(protocol, rig_.clock(), options.virtual_time,
                     fmt::format("{} {}", protocol.name, plan.schedule.observer.label), tell);
    for (const std::string& description : markers_->descriptions())
        fmt::print("markers: {}\n", description);
    const bool beeps = protocol.calibration.beeps && rig_.tracker().measures_gaze() && !options.virtual_time;
    const bool tones = !options.virtual_time && std::ranges::any_of(protocol.tasks, [](const Task& task) {
        return have_tones(task.steps);
    });
    sounds_.emplace(beeps || tones);
    if (beeps || tones)
        fmt::print("sounds: {}\n", sounds_->description());
    if (tones && !sounds_->are_heard() && !options.simulate_observer)
        throw InputError(
            fmt::format("the observer would not hear the tone of the feedback ({}): plug in what "
                        "plays, or take `tone` out of the protocol's steps",
                        sounds_->description()));
    answers_.reset(new AnswerEquipment(rig_.answer_equipment())); // it cannot be moved
    fmt::print("spoken answers: {}\n", answers_->description());
}

std::vector<std::string> SessionEquipment::closing_warnings() const {
    std::vector<std::string> warnings = rig_.closing_warnings();
    if (buttons_)
        for (std::string& warning : buttons_->closing_warnings())
            warnings.push_back(std::move(warning));
    return warnings;
}

} // namespace overt
