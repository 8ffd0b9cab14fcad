#include "app/inputs/protocol_inputs.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "experiment/base/error.h"
#include "experiment/checks/checked_protocol.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/making/mesh_parts.h"
#include "experiment/spectra/metal_table.h"
#include "experiment/stimulus/disparity.h"
#include "experiment/stimulus/object_size.h"
#include "render/image/light_probe.h"
#include "render/image/linear_image.h"
#include "render/image/probe_facts.h"
#include "render/stimulus/given_maps.h"
#include "render/stimulus/ready_made_frames.h"

namespace overt {

namespace {

/// Findings are parts of a sentence; errors and remarks are whole ones.
std::string as_finding(std::string message) {
    if (message.ends_with('.'))
        message.pop_back();
    return message;
}

/// Notes what goes wrong with one input at the key that names it.
template <class Work>
void examine(const Protocol& protocol, Place place, Diagnostics& diagnostics, const Work& work) {
    try {
        work();
    } catch (const InputError& error) {
        diagnostics.error(protocol.file.string(), place, as_finding(error.what()));
    }
}

/// Notes each area of an object that cannot be where it is described.
template <class Work>
void examine_areas(const Protocol& protocol, std::size_t object, Diagnostics& diagnostics, const Work& work) {
    try {
        work();
    } catch (const AreaError& error) {
        for (const AreaError::Fault& fault : error.faults())
            diagnostics.error(
                protocol.file.string(),
                protocol.places.first_written({fmt::format("object[{}].areas.{}", object, fault.area),
                                               fmt::format("object[{}].{}", object, fault.area)}),
                as_finding(fault.message));
    }
}

bool gives_head_share(const Protocol& protocol) {
    return std::ranges::any_of(protocol.tasks,
                               [](const Task& task) { return simulated_shares(task).front().second > 0.0; });
}

void examine_cameras(const Protocol& protocol, const Object& object, Diagnostics& diagnostics) {
    const PoseTable poses = poses_of(protocol);
    for (std::size_t view = 0; view < protocol.views.size(); ++view) {
        // A camera that overt places itself has the object in its picture.
        if (!protocol.views[view].camera_position)
            continue;
        const auto outside = std::ranges::find_if(poses.angles, [&](const ObjectPose& angle) {
            return !is_in_picture(object, static_cast<int>(view), angle);
        });
        if (outside == poses.angles.end())
            continue;
        diagnostics.error(protocol.file.string(),
                          protocol.places.of(fmt::format("view[{}].camera_position", view)),
                          fmt::format("object \"{}\" is nowhere in the picture at {:.3g} degrees", object.id,
                                      outside->angle.value),
                          "the camera looks at view.camera_target; lengths are in the unit of the mesh");
    }
}

std::vector<Object> examine_objects(const Protocol& protocol, const std::filesystem::path& cache,
                                    Diagnostics& diagnostics) {
    std::vector<Object> objects;
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        const ObjectSettings& settings = protocol.objects[i];
        const Place place = protocol.places.first_written({fmt::format("object[{}].mesh", i),
                                                           fmt::format("object[{}].shipped", i),
                                                           fmt::format("object[{}].picture", i)});
        examine(protocol, place, diagnostics, [&] {
            std::optional<Object> loaded;
            examine_areas(protocol, i, diagnostics, [&] { loaded = load_object(settings, protocol, cache); });
            if (!loaded)
                return;
            const Object& object = objects.emplace_back(*std::move(loaded));
            for (const std::string& remark : object.remarks)
                diagnostics.warning(protocol.file.string(), place, as_finding(remark));
            if (!object.has_mesh())
                return;
            examine_cameras(protocol, object, diagnostics);
            if (const auto disparity = disparity_of(object, protocol);
                disparity && disparity->most() > protocol.stereo.largest_disparity_arcmin)
                diagnostics.warning(
                    protocol.file.string(), place,
                    fmt::format("object \"{}\": the two eyes see it up to {:.0f} arcmin apart, more than "
                                "largest_disparity_arcmin = {:g}: some observers will see it double",
                                settings.id, disparity->most(), protocol.stereo.largest_disparity_arcmin),
                    "make it flatter or smaller, or move the observer away");
            const std::string unit = fmt::format("object[{}].unit", i);
            if (const auto doubt =
                    doubt_of_size(size_of(object, settings, protocol),
                                  protocol.places.is_written(unit) || !settings.shipped.empty()))
                diagnostics.warning(protocol.file.string(), place,
                                    fmt::format("object \"{}\": {}", settings.id, doubt->message),
                                    doubt->hint);
        });
    }
    return objects;
}

/// Gaze can be meant for areas that an object has, and for each place by one of them.
void examine_simulated_areas(const Experiment& experiment, Diagnostics& diagnostics) {
    const Protocol& protocol = experiment.protocol;
    const std::vector<std::string> areas = areas_of(experiment.objects);
    const auto error = [&](const std::string& key, std::string message, std::string hint) {
        diagnostics.error(protocol.file.string(), protocol.places.of(key), std::move(message),
                          std::move(hint));
    };
    const auto expect_known = [&](const std::string& key, const std::string& area) {
        const bool is_known = std::ranges::find(areas, area) != areas.end();
        if (!is_known)
            error(key, fmt::format("no object has an area \"{}\"", area),
                  areas.empty() ? std::string("areas are described by \"areas\" in [[object]]")
                                : fmt::format("there are {}", fmt::join(areas, ", ")));
        return is_known;
    };
    std::vector<std::string> meant{std::string(head_area)};
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i) {
        const std::string key = fmt::format("task[{}].simulated_area_shares", i);
        for (const auto& [area, share] : protocol.tasks[i].simulated_area_shares) {
            if (!expect_known(key, area) || std::ranges::find(meant, area) != meant.end())
                continue;
            for (const Object& object : experiment.objects) {
                const Areas own(object.mesh->part_names);
                const auto overlaps = [&](const std::string& other) {
                    const auto a = own.find(area), b = own.find(other);
                    for (std::size_t part = 0; a && b && part < object.mesh->part_names.size(); ++part) {
                        const auto index = static_cast<PartIndex>(part);
                        if (own.holds(*a, index) && own.holds(*b, index))
                            return true;
                    }
                    return false;
                };
                const auto other = std::ranges::find_if(meant, overlaps);
                if (other != meant.end() && (*other != head_area || gives_head_share(protocol)))
                    error(key,
                          fmt::format(
                              "on object \"{}\" the areas \"{}\" and \"{}\" overlap, and both have shares",
                              object.id, area, *other),
                          "give shares to areas that lie beside each other; the analysis tells of all");
            }
            meant.push_back(area);
        }
    }
    for (std::size_t i = 0; i < protocol.tasks.size(); ++i) {
        double all = 0.0;
        for (const auto& [area, share] : simulated_shares(protocol.tasks[i]))
            all += share;
        for (const Object& object : experiment.objects) {
            const Areas own(object.mesh->part_names);
            const auto is_meant = [&](std::size_t part) {
                return std::ranges::any_of(meant, [&](const std::string& area) {
                    const auto found = own.find(area);
                    return found && own.holds(*found, static_cast<PartIndex>(part));
                });
            };
            bool is_whole = object.has_mesh();
            for (std::size_t part = 0; part < object.mesh->part_names.size(); ++part)
                is_whole = is_whole && is_meant(part);
            if (is_whole && all < 1.0 - 1e-9 && !protocol.tasks[i].simulated_area_shares.empty())
                diagnostics.warning(
                    protocol.file.string(),
                    protocol.places.of(fmt::format("task[{}].simulated_area_shares", i)),
                    fmt::format(
                        "areas with shares are all of object \"{}\", and their shares come to {:.3g}: what "
                        "is left goes to the first of them",
                        object.id, all),
                    "let the shares come to 1");
        }
    }
    for (std::size_t i = 0; i < protocol.simulated_effects.size(); ++i) {
        const std::string &area = protocol.simulated_effects[i].area,
                          key = fmt::format("simulated_effect[{}].area", i);
        if (!area.empty() && expect_known(key, area) && std::ranges::find(meant, area) == meant.end())
            error(key, fmt::format("no task says how often \"{}\" is looked at", area),
                  fmt::format("give simulated_area_shares = {{ {} = 0.2 }} in a [[task]]", area));
    }
}

void examine_given_maps(const Protocol& protocol, Diagnostics& diagnostics) {
    ProgressBar bar;
    const int count = static_cast<int>(protocol.objects.size());
    for (int i = 0; i < count; ++i) {
        if (protocol.objects[static_cast<std::size_t>(i)].lut.empty())
            continue;
        bar.update("reading ready-made maps", i, count);
        const Place place = protocol.places.of(fmt::format("object[{}].lut", i));
        examine(protocol, place, diagnostics, [&] {
            for (const std::string& remark : check_given_maps(protocol, i))
                diagnostics.warning(protocol.file.string(), place, as_finding(remark));
        });
    }
}

void examine_surroundings(const Protocol& protocol, Diagnostics& diagnostics) {
    for (std::size_t i = 0; i < protocol.lights.size(); ++i) {
        const LightSettings& light = protocol.lights[i];
        if (!light.is_file())
            continue;
        const Place probe = protocol.places.of(fmt::format("light[{}].probe", i));
        examine(protocol, probe, diagnostics, [&] {
            const LightProbe surroundings = load_light_probe(light);
            const std::optional<ProbeFacts> facts = probe_facts(surroundings);
            if (facts && facts->is_too_even_for_gloss() && !light.has_sources())
                diagnostics.warning(protocol.file.string(), probe,
                                    fmt::format("{} is too even for gloss to be seen by: its brightest place "
                                                "has {:.0f} times the mean",
                                                light.probe, facts->brightest),
                                    "for matt objects it does; else add sun_lux or lamps, or take a probe "
                                    "with lamps or windows");
            if (facts && facts->has_clipped_sun())
                diagnostics.warning(protocol.file.string(), probe,
                                    fmt::format("the brightest places of {} are all alike, {:.0f} times the "
                                                "mean: a sun or lamps that the camera cut off",
                                                light.probe, facts->brightest),
                                    "gloss looks weaker under it than it is; sun_lux puts the sun back");
            if (const int negative = surroundings.negative_texels; negative > 0) {
                diagnostics.warning(protocol.file.string(), probe,
                                    fmt::format("{} texels of {} hold negative light, which counts as none",
                                                negative, light.probe));
            }
        });
    }
    for (std::size_t i = 0; i < protocol.materials.size(); ++i) {
        examine(protocol, protocol.places.of(fmt::format("material[{}].metal", i)), diagnostics,
                [&] { load_metal(protocol.materials[i].metal); });
    }
}

void examine_frames(const Protocol& protocol, Diagnostics& diagnostics) {
    ProgressBar bar;
    const int count = static_cast<int>(protocol.frames.size());
    for (int i = 0; i < count; ++i) {
        const FrameSequenceSettings& sequence = protocol.frames[static_cast<std::size_t>(i)];
        bar.update("reading ready-made frames", i, count);
        const Place place = protocol.places.of(place_of_frames(protocol, static_cast<std::size_t>(i)));
        examine(protocol, place, diagnostics, [&] {
            const Stimulus stimulus = stimulus_of(protocol, sequence);
            const ViewSettings& view = protocol.view_of(stimulus);
            check_frame_pixels(sequence, protocol.motion_of(stimulus).frame_count,
                               {view.width_px, view.height_px});
            if (sequence.colour_space == FrameColours::display &&
                has_other_primaries(frame_file(sequence, {0})))
                diagnostics.warning(
                    protocol.file.string(), place,
                    "the frames say that their colours are of another space, but their numbers are "
                    "shown as the display's own light",
                    "colour_space = \"rec709\" converts what they say to the display");
        });
    }
}

/// Gaze is waited for on areas that every object has: a trial of any of them can come.
void examine_waited_areas(const Experiment& experiment, Diagnostics& diagnostics) {
    for (const Task& task : experiment.protocol.tasks)
        for (const StepSettings& step : task.steps)
            for (const Object& object : experiment.objects) {
                if (!step.gaze || step.gaze->area.empty())
                    continue;
                const std::vector<std::string>& parts = object.mesh->part_names;
                if (object.has_mesh() && std::ranges::any_of(parts, [&](const std::string& part) {
                        return part_is_in_area(part, step.gaze->area);
                    }))
                    continue;
                diagnostics.error(
                    experiment.protocol.file.string(), step.gaze->area_place,
                    fmt::format("gaze_on: object \"{}\" has no area \"{}\"", object.id, step.gaze->area),
                    object.has_mesh() ? fmt::format("it has {}", fmt::join(parts, ", "))
                                      : "it has no mesh, and so no surface to look at");
            }
}

void place_points(Experiment& experiment, Diagnostics& diagnostics) {
    const Protocol& protocol = experiment.protocol;
    for (std::size_t list = 0; list < protocol.point_lists.size(); ++list)
        for (std::size_t i = 0; i < experiment.objects.size(); ++i)
            examine(protocol, protocol.places.of(fmt::format("points[{}].id", list)), diagnostics,
                    [&] { add_points(experiment.objects[i], protocol, protocol.point_lists[list], i); });
}

/// Nothing if there is an error, now or before.
std::optional<Experiment> look_into(std::optional<Protocol> protocol, const std::filesystem::path& cache,
                                    InputDepth depth, Diagnostics& diagnostics) {
    if (!protocol)
        return std::nullopt;
    Experiment experiment{*std::move(protocol), {}};
    experiment.objects = examine_objects(experiment.protocol, cache, diagnostics);
    if (!diagnostics.has_errors()) {
        examine_waited_areas(experiment, diagnostics);
        place_points(experiment, diagnostics);
    }
    examine_simulated_areas(experiment, diagnostics);
    examine_surroundings(experiment.protocol, diagnostics);
    if (depth == InputDepth::everything) {
        examine_frames(experiment.protocol, diagnostics);
        examine_given_maps(experiment.protocol, diagnostics);
    }
    if (diagnostics.has_errors())
        return std::nullopt;
    return experiment;
}

} // namespace

std::optional<Experiment> read_experiment(const std::filesystem::path& file,
                                          const std::filesystem::path& cache, InputDepth depth,
                                          Diagnostics& diagnostics) {
    return look_into(read_protocol_file(file, diagnostics), cache, depth, diagnostics);
}

std::optional<Experiment> read_recorded_experiment(const RecordedProtocol& recorded,
                                                   const std::filesystem::path& file,
                                                   const std::filesystem::path& cache,
                                                   Diagnostics& diagnostics) {
    IncludedTexts included;
    for (const RecordedProtocol::Included& part : recorded.included)
        included[part.name] = part.text;
    return look_into(read_protocol_text(recorded.text, file, shipped_sculpture_names(), diagnostics, included,
                                        FilesNamed::looked_up),
                     cache, InputDepth::everything, diagnostics);
}

Experiment read_experiment_or_report(const std::filesystem::path& file, const std::filesystem::path& cache,
                                     InputDepth depth) {
    Diagnostics diagnostics;
    std::optional<Experiment> experiment = read_experiment(file, cache, depth, diagnostics);
    print_findings(diagnostics);
    if (!experiment)
        throw FindingsPrinted(fmt::format("{}: cannot be used", file.string()));
    return *std::move(experiment);
}

} // namespace overt
