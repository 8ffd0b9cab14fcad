#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/check/check_commands.h"
#include "app/check/frame_cost.h"
#include "app/check/frame_light.h"
#include "app/check/lamp_check.h"
#include "app/check/light_report.h"
#include "app/check/rig_forecast.h"
#include "app/check/screen_pictures.h"
#include "app/check/silhouette_check.h"
#include "app/check/streaming_cost.h"
#include "app/check/text_check.h"
#include "app/cli/own_folders.h"
#include "app/inputs/protocol_file.h"
#include "app/inputs/protocol_inputs.h"
#include "app/rig/answer_equipment.h"
#include "app/stimuli/bake_estimate.h"
#include "experiment/base/counted.h"
#include "experiment/checks/design_report.h"
#include "experiment/checks/opened_things.h"
#include "experiment/design/answer_words.h"
#include "experiment/design/procedure_trials.h"
#include "experiment/design/schedule.h"
#include "experiment/design/trial_plan.h"
#include "render/gl/headless_context.h"

namespace overt {

namespace {

SurfaceFacts surface_of(const Object& object, const ObjectSettings& settings, const Protocol& protocol) {
    SurfaceFacts facts{object.id,
                       object.mesh->triangles.size(),
                       size_of(object, settings, protocol),
                       {},
                       disparity_of(object, protocol)};
    const std::vector<double> areas = object.mesh->part_areas();
    const double area = object.mesh->area();
    for (std::size_t part = 0; part < areas.size(); ++part)
        facts.part_shares.emplace_back(object.mesh->part_names[part], areas[part] / area);
    return facts;
}

/// What only a look at the stimuli themselves tells.
struct StimulusFacts {
    std::vector<SequenceSilhouette> silhouettes;
    BakeEstimate rendering;
    std::vector<ForecastLine> on_this_machine;
    FrameCost cost;
    std::optional<StreamingCost> streaming;
};

StimulusFacts look_at_stimuli(const Experiment& experiment, Diagnostics& diagnostics) {
    const auto context = make_headless_context(std::nullopt);
    StimulusLibrary library(*context, experiment.protocol, experiment.objects, cache_folder());
    StimulusFacts facts{check_silhouettes(experiment, library, diagnostics),
                        bake_estimate(experiment, library), rig_forecast(experiment.protocol),
                        measure_frame_cost(*context, experiment.protocol, experiment.objects),
                        measure_streaming(*context, experiment.protocol, library)};
    for (ForecastLine& line : forecast_of(facts.cost, experiment.protocol, context->description()))
        facts.on_this_machine.push_back(std::move(line));
    if (facts.streaming) {
        facts.on_this_machine.push_back(forecast_of(*facts.streaming));
        check_streaming(*facts.streaming, experiment.protocol, diagnostics);
    }
    return facts;
}

DesignReport report_on(const Experiment& experiment, const CheckOptions& options) {
    std::vector<Observer> observers = planned_observers(experiment.protocol);
    if (!options.observer.empty()) {
        observers = {observer_labelled(options.observer)};
    } else if (!options.all_observers) {
        observers.resize(1);
    }
    DesignAssumptions assumptions;
    assumptions.answer_s = options.answer_time_s;
    DesignReport report = make_design_report(experiment.protocol, observers, options.seed.value_or(1),
                                             assumptions, options.seed.has_value());
    for (std::size_t i = 0; i < experiment.objects.size(); ++i) {
        if (experiment.objects[i].has_mesh())
            report.surfaces.push_back(
                surface_of(experiment.objects[i], experiment.protocol.objects[i], experiment.protocol));
    }
    report.recording = recording_size(experiment.protocol, experiment.objects, report.trials_per_observer,
                                      assumptions.answer_s);
    return report;
}

std::string steps_of_tasks(const Protocol& protocol) {
    std::string text;
    for (const Task& task : protocol.tasks)
        text += describe_steps(protocol, task) + describe_answers(protocol, task) +
                describe_procedures(protocol, task);
    return text;
}

nlohmann::ordered_json opened_json(const Protocol& protocol) {
    auto list = nlohmann::ordered_json::array();
    for (const OpenedThing& thing : opened_by(protocol))
        list.push_back({{"kind", thing.kind}, {"whose", thing.whose}, {"what", thing.what}});
    return list;
}

} // namespace

int run_check(const CheckOptions& options) {
    Diagnostics diagnostics;
    const std::optional<Experiment> experiment =
        read_experiment(options.protocol, cache_folder(), InputDepth::everything, diagnostics);
    const std::optional<StimulusFacts> stimuli =
        experiment ? std::optional(look_at_stimuli(*experiment, diagnostics)) : std::nullopt;
    if (experiment) {
        check_texts(experiment->protocol, diagnostics);
        check_lamps(*experiment, diagnostics);
    }
    const std::string sound = experiment ? check_sound(experiment->protocol, diagnostics) : std::string();
    std::string text;
    if (options.json) {
        nlohmann::ordered_json json = diagnostics.to_json();
        if (experiment) {
            json["design"] = to_json(report_on(*experiment, options));
            json["rendering"] = to_json(stimuli->rendering);
            json["silhouettes"] = to_json(stimuli->silhouettes);
            json["on_this_machine"] = to_json(stimuli->on_this_machine);
            json["frame_cost"] = to_json(stimuli->cost);
            if (stimuli->streaming)
                json["from_disk"] = to_json(*stimuli->streaming);
            json["spoken_answers"] = sound;
            json["surroundings"] = to_json(measure_lights(experiment->protocol));
            json["opens"] = opened_json(experiment->protocol);
            if (options.frames)
                json["light"] = to_json(measure_light(*experiment));
        }
        text = json.dump(2) + "\n";
    } else {
        print_findings(diagnostics);
        if (experiment)
            text = needs_of_person(stimuli->rendering, experiment->protocol) +
                   to_text(report_on(*experiment, options)) + steps_of_tasks(experiment->protocol) +
                   to_text(stimuli->silhouettes) + to_text(measure_lights(experiment->protocol)) +
                   to_text(stimuli->rendering) + to_text(stimuli->on_this_machine) + sound +
                   to_text(opened_by(experiment->protocol)) + "\n";
        if (experiment && options.frames)
            text += to_text(measure_light(*experiment));
    }
    std::fwrite(text.data(), 1, text.size(), stdout);
    if (experiment && !options.screens.empty())
        fmt::print(
            stderr, "{} in {}\n",
            counted(static_cast<std::size_t>(write_screen_pictures(experiment->protocol, options.screens)),
                    "picture"),
            options.screens.string());
    return diagnostics.error_count() == 0 ? 0 : 2;
}

} // namespace overt
