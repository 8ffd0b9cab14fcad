#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/inputs/session_folders.h"
#include "app/record/chosen_presentation.h"
#include "app/record/picture_marks.h"
#include "app/record/plot_canvas.h"
#include "app/record/record_commands.h"
#include "app/record/recorded_order.h"
#include "app/record/recorded_surface.h"
#include "app/record/timing_plot.h"
#include "app/record/timing_text.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/preview_file.h"
#include "experiment/record/read/rig_pages.h"
#include "experiment/record/read/sample_join.h"
#include "experiment/record/read/session_faults.h"
#include "experiment/record/session_directory.h"
#include "render/stimulus/trial_picture.h"

namespace overt {

namespace {

const TrialRecord& trial_numbered(const SessionRecord& record, int number) {
    for (const TrialRecord& trial : record.trials()) {
        if (trial.trial.index + 1 == number && trial.counts)
            return trial;
    }
    throw InputError(fmt::format("{}: has no completed trial {}", record.directory().string(), number));
}

nlohmann::ordered_json gaze_share_of(const TrialRecord& trial) {
    const std::optional<GazeYield>& gaze = trial.outcome.gaze;
    return gaze ? nlohmann::ordered_json(gaze->share()) : nlohmann::ordered_json();
}

/// Lists with several entries, always object and material, and columns.
bool is_shown(const Factor& factor) {
    return factor.source == Factor::Source::column ||
           (factor.source == Factor::Source::list &&
            (factor.levels.size() > 1 || stimulus_lists[factor.list].is_always_named));
}

nlohmann::ordered_json session_json(const SessionRecord& record) {
    const SessionHeader& header = record.header();
    const Factors factors = factors_of(header);
    auto trials = nlohmann::ordered_json::array();
    for (const TrialRecord& trial : record.trials()) {
        nlohmann::ordered_json item{{"trial", trial.trial.index + 1},
                                    {"task", header.tasks[static_cast<std::size_t>(trial.trial.task)].id}};
        for (const Factor& factor : factors.all())
            if (is_shown(factor))
                item[factor.name] =
                    factor.levels[static_cast<std::size_t>(factors.level_of(factor, trial.trial))].name;
        item.update({{"attempt", trial.attempt},
                     {"status", name_of(trial.status)},
                     {"counts", trial.counts},
                     {"failure", trial.outcome.failure},
                     {"sitting", trial.sitting},
                     {"shown_refreshes", trial.outcome.shown_refreshes},
                     {"missed_refreshes", header.is_timing_unproven()
                                              ? nlohmann::ordered_json("unproven")
                                              : nlohmann::ordered_json(trial.outcome.missed_refreshes)},
                     {"gaze_share", gaze_share_of(trial)},
                     {"response_key", trial.response_key},
                     {"answer", trial.outcome.answer}});
        trials.push_back(std::move(item));
        for (std::size_t i = 0; i < trial.trial.shown_count() && !trial.trial.beside.empty(); ++i) {
            const auto [stimulus, slot] = trial.trial.shown(i);
            trials.back()["shown"].push_back(
                {{"slot", header.slots[static_cast<std::size_t>(slot)].id},
                 {"object", header.objects[static_cast<std::size_t>(stimulus.object)].id},
                 {"material", header.materials[static_cast<std::size_t>(stimulus.material)].id}});
        }
    }
    nlohmann::ordered_json json{{"session", record.directory().string()},
                                {"protocol", header.protocol.name},
                                {"observer", header.schedule.observer.label},
                                {"seed", header.schedule.seed},
                                {"closed_in_order", record.closed_in_order()},
                                {"timing_proof", header.display.timing},
                                {"trials", trials},
                                {"faults", nlohmann::ordered_json::array()}};
    for (const SessionFault& fault : faults_of(record))
        json["faults"].push_back(
            {{"of", name_of(fault.side)},
             {"sitting", fault.sitting},
             {"trial", fault.trial < 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(fault.trial + 1)},
             {"what", fault.what},
             {"detail", fault.detail}});
    const SimulatedSides simulated = simulated_sides(record);
    json["simulated_faults"] = {{"display", simulated.display}, {"eye_tracker", simulated.eye_tracker}};
    if (const auto& light = header.characterisation) {
        json["characterisation"] = {{"display", light->display},
                                    {"date", light->date},
                                    {"sha256", light->sha256},
                                    {"white_cd_m2", light->white_cd_m2()},
                                    {"black_cd_m2", light->black_xyz.y}};
    }
    if (!header.further_tracker.empty())
        json["further_tracker"] = header.further_tracker;
    else if (const std::vector<std::string> further = further_trackers_of(record.directory());
             !further.empty())
        json["further_trackers"] = further;
    json["rig_pages"] = nlohmann::ordered_json::array();
    for (const auto& [sitting, page] : rig_pages_of(record))
        json["rig_pages"].push_back({{"sitting", sitting}, {"page", page}});
    json["display_boxes"] = nlohmann::ordered_json::array();
    for (const auto& [sitting, box] : record.display_boxes()) {
        nlohmann::ordered_json item{{"sitting", sitting}, {"use", name_of(box.use)}};
        if (box.use == RecordedBox::Use::box) {
            item["product"] = box.product;
            item["serial_number"] = box.serial_number;
            item["mode"] = box.mode;
            item["video_rate_hz"] = box.video_rate_hz;
        }
        json["display_boxes"].push_back(std::move(item));
    }
    return json;
}

/// An attempt's status, and of one that does not count why; what speaks against one that counts.
std::string fate_of(const TrialRecord& trial) {
    if (trial.status == TrialRecord::Status::completed && !trial.counts)
        return "superseded";
    if (trial.status == TrialRecord::Status::completed)
        return trial.outcome.failure.empty() ? "completed" : "completed, " + trial.outcome.failure;
    return trial.status == TrialRecord::Status::aborted && !trial.outcome.failure.empty()
               ? trial.outcome.failure
               : std::string(name_of(trial.status));
}

/// Each device's under its own heading.
void print_faults(const SessionRecord& record) {
    constexpr int most_lines = 20;
    const std::vector<SessionFault> faults = faults_of(record);
    if (simulated_sides(record).eye_tracker)
        fmt::print("\nTHE EYE TRACKER'S FAULTS WERE SIMULATED: a trial run, no measurement\n");
    int lines = 0;
    for (std::size_t i = 0; i < faults.size(); ++i) {
        const SessionFault& fault = faults[i];
        if (i == 0 || fault.side != faults[i - 1].side) {
            fmt::print("\nwhat went wrong: {}\n", name_of(fault.side));
            lines = 0;
        }
        if (++lines > most_lines) {
            if (lines == most_lines + 1)
                fmt::print("  … and more: the table of events has all of it\n");
            continue;
        }
        fmt::print("  {}: {}{}{}\n",
                   fault.trial < 0 ? "between trials" : fmt::format("trial {}", fault.trial + 1), fault.what,
                   fault.detail.empty() ? "" : ": ", fault.detail);
    }
}

void print_session(const SessionRecord& record) {
    const nlohmann::ordered_json json = session_json(record);
    const SessionHeader& header = record.header();
    fmt::print("{}: observer {}, session {}, seed {}, {} ({})\n", header.protocol.name,
               header.schedule.observer.label, header.session_number, header.schedule.seed,
               header.graphics.context, header.graphics.renderer);
    if (!header.further_tracker.empty())
        fmt::print("the record of the further eye tracker {} ({})\n", header.further_tracker,
                   header.tracker.name);
    for (const std::string& id : further_trackers_of(record.directory()))
        fmt::print("further eye tracker {}: its record is {}\n", id,
                   further_record(record.directory(), id).string());
    for (const auto& [sitting, box] : record.display_boxes())
        fmt::print("display box in sitting {}: {}\n", sitting, describe(box));
    for (const auto& [sitting, page] : rig_pages_of(record))
        fmt::print("page of the rig in sitting {}: {}\n", sitting, page);
    const Factors factors = factors_of(header);
    std::string names;
    for (const Factor& factor : factors.all())
        if (is_shown(factor))
            names += fmt::format("{:<12} ", factor.name);
    fmt::print("\n{:>5}  {:<12} {}{:<21} {:>9} {:>8} {:>7}  {}\n", "trial", "task", names, "status",
               "refreshes", "missed", "gaze", "answer");
    for (std::size_t i = 0; i < record.trials().size(); ++i) {
        const auto& trial = json["trials"][i];
        const std::optional<GazeYield>& gaze = record.trials()[i].outcome.gaze;
        std::string levels;
        for (const Factor& factor : factors.all())
            if (is_shown(factor))
                levels += fmt::format("{:<12} ", trial[factor.name].get<std::string>());
        fmt::print("{:>5}  {:<12} {}{:<21} {:>9} {:>8} {:>7}  {}\n", trial["trial"].get<int>(),
                   trial["task"].get<std::string>(), levels, fate_of(record.trials()[i]),
                   trial["shown_refreshes"].get<int>(),
                   header.is_timing_unproven() ? "unproven"
                                               : std::to_string(trial["missed_refreshes"].get<int>()),
                   gaze ? fmt::format("{:.1f} %", 100.0 * gaze->share()) : "n/a",
                   trial["answer"].get<std::string>());
        for (std::size_t k = 0; trial.contains("shown") && k < trial["shown"].size(); ++k) {
            const auto& shown = trial["shown"][k];
            fmt::print("{:>5}  {:<12} {:<12} {:<12} in slot {}\n", "", "", shown["object"].get<std::string>(),
                       shown["material"].get<std::string>(), shown["slot"].get<std::string>());
        }
    }
    if (!record.closed_in_order())
        fmt::print("\nThe session was not closed in order: it is running, or was killed.\n");
    print_faults(record);
    print_timing(timing_report(record));
    print_input_delays(input_delays(record));
}

void write_plot(const SessionRecord& record, const std::filesystem::path& file) {
    const SessionHeader& header = record.header();
    PlotCanvas::check_ending(file); // before the session is read
    write_timing_plot(timing_report(record),
                      fmt::format("Timing of {}, observer {}, session {}", header.protocol.name,
                                  header.schedule.observer.label, header.session_number),
                      file);
    fmt::print("plot: {}\n", file.string());
}

/// Half a degree of visual angle, about the accuracy of a good calibration, in the unit of the mesh.
double kernel_sigma(const SessionHeader& header, const Stimulus& stimulus) {
    const RecordedObject& recorded = header.objects[static_cast<std::size_t>(stimulus.object)];
    const Camera& camera = header.camera_of(stimulus);
    const double depth = glm::distance(camera.position, recorded.bounds.centre());
    const double image_height = 2.0 * depth * std::tan(0.5 * to_radians(camera.vertical_fov).value);
    return 0.5 * header.display.screen.px_per_deg_at_centre() * image_height /
           header.screen_of_view(stimulus.view).image_px.y;
}

void write_picture(const SessionRecord& record, const TrialRecord& trial, const std::filesystem::path& file) {
    const SessionHeader& header = record.header();
    const int object = trial.trial.stimulus.object;
    RecordedSurfaces surfaces(record);
    const SurfaceLookup* surface = surfaces.lookup_of(viewed_in(header, trial.trial));
    if (!surface)
        throw InputError(fmt::format("object \"{}\" has no map: there is no surface to show gaze on",
                                     header.objects[static_cast<std::size_t>(object)].id));
    const SampleJoin join(record, trial, surface);
    std::vector<glm::dvec3> gaze;
    for (const GazeSample& sample : record.samples(trial)) {
        const JoinedSample joined = join.join(sample);
        if (joined.sight.surface)
            gaze.push_back(joined.sight.surface->position);
    }
    const Stimulus stimulus = header.in_slot(trial.trial.shown(0));
    TrialPictureContent content;
    content.surface = surface;
    content.bounds = header.objects[static_cast<std::size_t>(object)].bounds;
    content.pose = header.poses.pose_of(stimulus.motion, {0});
    content.frame = read_linear_image(require_file_inside(record.directory(), preview_file(header, stimulus)),
                                      FrameEncoding::srgb);
    const PictureMarks marks(record, trial, surface);
    marks.draw_set(content.frame, {0});
    content.gaze_on_surface = gaze;
    content.kernel_sigma = kernel_sigma(header, stimulus);
    content.frame_caption = fmt::format("{}, {}", header.objects[static_cast<std::size_t>(object)].title,
                                        header.materials[static_cast<std::size_t>(stimulus.material)].title);
    content.map_caption = "Hidden map: place on the surface as colour";
    content.gaze_caption =
        fmt::format("Gaze of trial {}: {} samples on the surface, by their density; 1 is the densest place",
                    trial.trial.index + 1, gaze.size());
    write_srgb_png(file, draw_trial_picture(content));
    fmt::print("picture: {}\n", file.string());
}

} // namespace

namespace {

/// Of one session among others, one after the other; as JSON, of more than one a list. Gives the exit code.
int show_each(const std::vector<std::filesystem::path>& sessions, const ShowOptions& options) {
    auto list = nlohmann::ordered_json::array();
    bool is_well = true;
    for (const std::filesystem::path& session : sessions) {
        const SessionRecord record(session);
        if (options.order) {
            const RecordedOrder order = recorded_order(record.header());
            is_well &= order.is_same();
            if (options.json)
                list.push_back(to_json(order, record.header()));
            else
                fmt::print("{}{}", session == sessions.front() ? "" : "\n", to_text(order, record.header()));
        } else if (options.json) {
            nlohmann::ordered_json json = session_json(record);
            json["timing"] = to_json(timing_report(record));
            json["input_delays"] = to_json(input_delays(record));
            list.push_back(std::move(json));
        } else {
            fmt::print("{}", session == sessions.front() ? "" : "\n");
            print_session(record);
        }
    }
    if (options.json)
        fmt::print("{}", json_text(list.size() == 1 ? list.front() : list));
    return is_well ? 0 : 1;
}

} // namespace

int run_show(const ShowOptions& options) {
    const std::vector<std::filesystem::path> sessions = sessions_in(options.sessions);
    if (options.picture.empty() && options.plot.empty())
        return show_each(sessions, options);
    if (sessions.size() > 1)
        throw InputError(fmt::format("--{} is of one session, and {} were found: name it",
                                     options.picture.empty() ? "plot" : "picture", sessions.size()));
    const SessionRecord record(sessions.front());
    if (!options.picture.empty())
        write_picture(
            record,
            chosen_presentation(record, trial_numbered(record, options.trial.value_or(1)), options.slot),
            options.picture);
    else
        write_plot(record, options.plot);
    return 0;
}

} // namespace overt
