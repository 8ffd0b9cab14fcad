#include <chrono>
#include <future>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/interruption.h"
#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/inputs/protocol_file.h"
#include "app/stimuli/bake_estimate.h"
#include "app/stimuli/contact_sheet.h"
#include "app/stimuli/frame_export.h"
#include "app/stimuli/stimulus_commands.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/base/whole_file.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "render/gl/headless_context.h"

namespace overt {

namespace {

/// What is asked for, made sense of.
struct BakeJob {
    FrameQuality quality;
    std::vector<Stimulus> stimuli;
    FrameExportOptions output; ///< without a folder: frames go to the cache only
    std::vector<BakeUnit> units;

    bool exports() const { return !output.folder.empty(); }
};

FrameQuality quality_asked_for(const BakeOptions& options, const BakingSettings& baking) {
    // Who bakes wants more than what is there without baking.
    FrameQuality quality =
        quality_of(options.quality.value_or(std::max(baking.least(), BakeQuality::standard)), baking);
    if (!options.quality && baking.quality == BakeQuality::draft)
        quality = quality_of(BakeQuality::draft, baking);
    if (options.samples)
        quality.samples = options.samples;
    if (options.target_error_de)
        quality.target_error_de = options.target_error_de;
    return quality;
}

std::vector<Stimulus> stimuli_asked_for(const BakeOptions& options, const Protocol& protocol,
                                        const StimulusLibrary& library) {
    std::vector<Stimulus> stimuli;
    for (const std::string& name : options.only) {
        const Stimulus stimulus = stimulus_called(protocol, name);
        if (library.cache().is_ready_made(stimulus))
            throw InputError(fmt::format(
                "--stimulus {}: the protocol gives its [[frames]]; there is nothing to bake", name));
        for (const Stimulus& sized : at_all_sizes(protocol, stimulus))
            if (std::find(stimuli.begin(), stimuli.end(), sized) == stimuli.end())
                stimuli.push_back(sized);
    }
    if (stimuli.empty())
        stimuli = library.cache().rendered_stimuli();
    if (stimuli.empty())
        throw InputError(fmt::format("{}: all stimuli are ready-made [[frames]]; there is nothing to bake",
                                     protocol.file.string()));
    for (const Stimulus& stimulus : stimuli)
        library.cache().require_mesh(stimulus);
    return stimuli;
}

void check_combinations(const BakeOptions& options) {
    const bool exports = !options.out.empty();
    if (!exports && (options.as != "display" || options.png16 || options.half || options.force))
        throw InputError(
            "--as, --png16, --half and --overwrite are about files: say with --out where they go");
    if (options.png16 && options.as != "display")
        throw InputError(fmt::format("--png16 holds display light; {} needs the range of EXR", options.as));
    if (options.png16 && options.half)
        throw InputError("--png16 and --half are two kinds of file: choose one");
    if (!options.shard.empty() && !(options.sheet.empty() && options.strip.empty()))
        throw InputError("a shard has only some frames: make --sheet and --strip when all are there");
}

BakeJob job_of(const BakeOptions& options, const Protocol& protocol, const StimulusLibrary& library) {
    check_combinations(options);
    BakeJob job;
    job.quality = quality_asked_for(options, protocol.bake);
    job.stimuli = stimuli_asked_for(options, protocol, library);
    job.output.frames = frame_range_called(options.frames, protocol, job.stimuli);
    job.output.folder = options.out;
    job.output.as = options.as == "xyz"       ? ExportedLight::xyz
                    : options.as == "spectra" ? ExportedLight::spectra
                                              : ExportedLight::display;
    job.output.file = options.png16  ? ExportedFile::png16
                      : options.half ? ExportedFile::half_exr
                                     : ExportedFile::exr;
    job.output.force = options.force;
    for (const Stimulus& stimulus : job.stimuli)
        if (job.output.as == ExportedLight::spectra && !protocol.light_of(stimulus).sum.empty())
            throw InputError(fmt::format("--as spectra: the light \"{}\" is a sum, of which there are no "
                                         "spectra: choose the lights that it is of with --stimulus",
                                         protocol.light_of(stimulus).id));
    job.units = bake_units(job.stimuli, job.output.frames, library.cache(), job.quality, job.exports());
    if (!options.shard.empty())
        job.units = dealt_to(shard_called(options.shard), job.units);
    return job;
}

/// What happened, for the last lines and for programs.
struct BakeOutcome {
    std::size_t units = 0, kept = 0, rendered = 0;
    std::size_t waiting = 0; ///< to be added up of frames that other shards render
    double seconds = 0.0, rays = 0.0;
    double given_up = 0.0; ///< of the frame that has most: SpectralFrame
    bool interrupted = false;
    ClippedPixels clipped;
};

bool is_sum(const Protocol& protocol, const BakeUnit& unit) {
    return !protocol.light_of(unit.stimulus).sum.empty();
}

bool is_cached(const StimulusLibrary& library, const BakeJob& job, const BakeUnit& unit) {
    return library.cache().has_frame(unit.stimulus, job.quality, unit.pose);
}

/// Renders what is missing. While one frame is written, the next is traced; each is on the disk, whole, or
/// not there.
void render(const std::vector<BakeUnit>& missing, const BakeJob& job, StimulusLibrary& library,
            const FrameExport& output, BakeOutcome& outcome) {
    const Protocol& protocol = library.cache().protocol();
    double all = 0.0, done = 0.0;
    for (const BakeUnit& unit : missing)
        all += unit.cost;
    ProgressBar bar;
    const Interruption interruption;
    std::future<void> writing;
    const int count = static_cast<int>(missing.size());
    for (const BakeUnit& unit : missing) {
        const auto go_on = [&](double share) {
            bar.update("rendering", static_cast<int>(outcome.rendered), count,
                       all > 0.0 ? (done + share * unit.cost) / all : 0.0);
            return !Interruption::requested();
        };
        if (is_sum(protocol, unit)) {
            if (writing.valid())
                writing.get();
            const bool can_be = library.cache().can_add_up(unit.stimulus, unit.pose, job.quality);
            if (can_be)
                library.cache().add_up(unit.stimulus, unit.pose, job.quality);
            ++(can_be ? outcome.rendered : outcome.waiting);
            continue;
        }
        SpectralFrame frame;
        if (go_on(0.0))
            frame = library.frames().trace(unit.stimulus, unit.pose, job.quality, go_on);
        if (writing.valid())
            writing.get();
        if (!frame.is_complete) {
            outcome.interrupted = true;
            return;
        }
        outcome.rays += frame.rays;
        outcome.given_up = std::max(outcome.given_up, frame.given_up);
        done += unit.cost;
        ++outcome.rendered;
        writing = std::async(std::launch::async, [&, unit, frame = std::move(frame)] {
            if (!is_cached(library, job, unit))
                library.cache().store(unit.stimulus, unit.pose, job.quality, frame);
            if (job.output.as == ExportedLight::spectra && !unit.is_part)
                output.write(unit, &frame);
        });
    }
    if (writing.valid())
        writing.get();
    bar.update("rendering", count, count, 1.0);
}

/// Files of what is in the cache.
void export_cached(const BakeJob& job, const FrameExport& output, BakeOutcome& outcome) {
    std::vector<BakeUnit> missing;
    for (const BakeUnit& unit : job.units) {
        if (!unit.is_part && !output.has(unit))
            missing.push_back(unit);
    }
    if (missing.empty())
        return;
    ProgressBar bar;
    std::mutex mutex;
    int written = 0;
    parallel_for(static_cast<int>(missing.size()), [&](int i) {
        const ClippedPixels clipped = output.write(missing[static_cast<std::size_t>(i)], nullptr);
        const std::scoped_lock lock(mutex);
        outcome.clipped += clipped;
        bar.update("writing files", ++written, static_cast<int>(missing.size()));
    });
}

/// What a bake that was killed had begun to write.
void remove_remnants(const BakeJob& job, const StimulusLibrary& library, const FrameExport& output) {
    std::set<std::filesystem::path> folders;
    for (const BakeUnit& unit : job.units) {
        folders.insert(library.cache().frame_file_of(unit.stimulus, job.quality, unit.pose).parent_path());
        folders.insert(
            library.cache()
                .map_file(viewed(unit.stimulus), library.cache().poses().index_of(unit.pose.object))
                .parent_path());
        if (job.exports())
            folders.insert(output.folder_of(unit.stimulus));
    }
    for (const std::filesystem::path& folder : folders)
        remove_abandoned_files(folder);
}

void say_plan(const BakeJob& job, const Experiment& experiment, const std::vector<BakeUnit>& missing) {
    fmt::print("{}: {}, {} quality, {}, {} of them there already\n", experiment.protocol.name,
               counted(job.stimuli.size(), "stimulus", "stimuli"), describe(job.quality),
               counted(job.units.size(), "frame"), job.units.size() - missing.size());
    if (missing.empty())
        return;
    const PathProbe probe(experiment.protocol, experiment.objects);
    double seconds = 0.0;
    for (const BakeUnit& unit : missing)
        seconds += probe.seconds_of_frame(unit.stimulus, job.quality);
    fmt::print("{} to render, about {} on this machine\n", missing.size(), duration_text(seconds));
}

/// Where quality and protocol disagree, a session would not find the frames.
void say_use(const BakeJob& job, const Protocol& protocol) {
    if (job.quality == quality_of(job.quality.level, protocol.bake))
        return;
    fmt::print(
        "note: a session takes these frames if the protocol says so too:\n  [bake]\n  quality = \"{}\"\n",
        name_of(job.quality.level));
    if (job.quality.samples)
        fmt::print("  samples = {}\n", *job.quality.samples);
    if (job.quality.target_error_de)
        fmt::print("  target_error_de = {}\n", *job.quality.target_error_de);
}

void say_outcome(const BakeOptions& options, const BakeJob& job, const BakeOutcome& outcome,
                 const Protocol& protocol) {
    if (options.json) {
        const nlohmann::ordered_json json{{"quality", name_of(job.quality.level)},
                                          {"frames", outcome.units},
                                          {"there_before", outcome.kept},
                                          {"rendered", outcome.rendered},
                                          {"seconds", outcome.seconds},
                                          {"rays", outcome.rays},
                                          {"light_given_up", outcome.given_up},
                                          {"complete", !outcome.interrupted},
                                          {"out", options.out.string()}};
        fmt::print("{}\n", json.dump(2));
        return;
    }
    fmt::print("{} of {} are there, {} rendered now\n", outcome.kept + outcome.rendered,
               counted(outcome.units, "frame"), outcome.rendered);
    if (outcome.given_up > 0.0)
        fmt::print(
            "of a frame's light up to {:.2g} % was given up inside a translucent body, after a million "
            "scatterings: so much of it is missing\n",
            100.0 * outcome.given_up);
    if (outcome.waiting > 0)
        fmt::print(
            "{} to be added up of frames of other shards: run `overt bake` once more when all are there\n",
            counted(outcome.waiting, "frame"));
    if (outcome.interrupted) {
        fmt::print("interrupted; the same command goes on where it ended\n");
        return;
    }
    if (job.exports())
        fmt::print("files: {}\n", options.out.string());
    if (options.png16 && outcome.clipped.any()) {
        double worst = 0.0;
        for (std::size_t channel = 0; channel < 3; ++channel)
            worst =
                std::max({worst, outcome.clipped.share_below(channel), outcome.clipped.share_above(channel)});
        fmt::print("clipped to what 16 bits hold: up to {:.3g} % of the object's pixels in a channel\n",
                   100.0 * worst);
    }
    say_use(job, protocol);
}

/// The stimulus of a strip: the only one, or the one that is asked for.
Stimulus stimulus_of_strip(const BakeJob& job) {
    if (job.stimuli.size() != 1)
        throw InputError("--strip shows one stimulus: choose it with --stimulus");
    return job.stimuli.front();
}

/// All frames of the pictures have to be there.
void draw_overviews(const BakeOptions& options, const BakeJob& job, const Protocol& protocol,
                    StimulusLibrary& library) {
    library.take_frames(job.quality);
    if (!options.sheet.empty()) {
        write_srgb_png(options.sheet, contact_sheet(protocol, library, job.output.frames.first, 400));
        fmt::print("sheet: {}\n", options.sheet.string());
    }
    if (!options.strip.empty()) {
        write_srgb_png(options.strip, film_strip(library, stimulus_of_strip(job), job.output.frames, 9, 320));
        fmt::print("strip: {}\n", options.strip.string());
    }
}

} // namespace

namespace {

/// Those that files are to be of.
std::vector<BakeUnit> asked_for(std::vector<BakeUnit> units) {
    std::erase_if(units, &BakeUnit::is_part);
    return units;
}

} // namespace

int run_bake(const BakeOptions& options) {
    const Experiment experiment =
        read_experiment_or_report(options.protocol, cache_folder(), InputDepth::objects);
    const Protocol& protocol = experiment.protocol;
    const auto context = make_headless_context(options.context);
    StimulusLibrary library(*context, protocol, experiment.objects, cache_folder());
    const BakeJob job = job_of(options, protocol, library);
    if (!options.strip.empty())
        stimulus_of_strip(job);
    if (!options.sheet.empty() && job.stimuli.size() != library.cache().rendered_stimuli().size())
        throw InputError("--sheet shows all stimuli: leave out --stimulus");
    const FrameExport output(job.output, protocol, experiment.objects, library, job.quality);
    if (job.exports())
        output.refuse_to_replace(asked_for(job.units));
    std::vector<BakeUnit> missing;
    std::set<std::filesystem::path> rendered; // stimuli may share frames
    for (const BakeUnit& unit : job.units) {
        if (job.output.as == ExportedLight::spectra && !unit.is_part
                ? !output.has(unit)
                : !is_cached(library, job, unit) &&
                      rendered.insert(library.cache().frame_file_of(unit.stimulus, job.quality, unit.pose))
                          .second)
            missing.push_back(unit);
    }
    if (!options.json || options.dry_run)
        say_plan(job, experiment, missing);
    if (options.dry_run)
        return 0;

    remove_remnants(job, library, output);
    BakeOutcome outcome;
    outcome.units = job.units.size();
    outcome.kept = job.units.size() - missing.size();
    const auto begin = std::chrono::steady_clock::now();
    try {
        if (!missing.empty())
            render(missing, job, library, output, outcome);
        if (job.exports() && !outcome.interrupted)
            export_cached(job, output, outcome);
    } catch (const RecordError& error) {
        throw RecordError(fmt::format("{}. What was finished before is kept: make room, and the same command "
                                      "goes on.",
                                      error.what()));
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    say_outcome(options, job, outcome, protocol);
    if (!outcome.interrupted)
        draw_overviews(options, job, protocol, library);
    return outcome.interrupted ? 1 : 0;
}

} // namespace overt
