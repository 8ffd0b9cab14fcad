#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/bytes_in_words.h"
#include "experiment/base/counted.h"
#include "experiment/checks/design_report.h"
#include "experiment/colour/characterisation_text.h"
#include "experiment/motion_words.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

/// The angles that something as large as an image has in the middle of the screen.
glm::dvec2 slot_size_deg(const ScreenGeometry& screen) {
    const glm::dvec2 half_mm =
        0.5 * glm::dvec2(screen.image_px) * screen.screen_mm / glm::dvec2(screen.screen_px);
    return {to_degrees({2.0 * std::atan(half_mm.x / screen.viewing_distance_mm)}).value,
            to_degrees({2.0 * std::atan(half_mm.y / screen.viewing_distance_mm)}).value};
}

/// What the display makes of a frame rate that it only comes near to; nothing where it is exact.
std::string difference_of_rates(const DesignReport& report, const AnimationFacts& animation) {
    const double asked = animation.motion.frame_rate_hz;
    const double shown = report.display.refresh_hz / animation.refreshes_per_frame;
    const double percent = 100.0 * (shown / asked - 1.0);
    if (std::abs(percent) < 1e-3)
        return "";
    return fmt::format(" ({:.2g} % {} than the protocol's {} Hz)", std::abs(percent),
                       percent < 0.0 ? "slower" : "faster", asked);
}

std::size_t longest(const std::vector<std::string>& names) {
    std::size_t length = 0;
    for (const std::string& name : names)
        length = std::max(length, name.size());
    return length;
}

const std::string& at(const std::vector<std::string>& names, int index) {
    return names.at(static_cast<std::size_t>(index));
}

/// A heading in the left column and its lines beside it.
void add_facts(std::string& text, std::string_view heading, const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
        text += fmt::format("  {:<11}{}\n", i == 0 ? heading : "", lines[i]);
}

/// Of a protocol with [stereo]: the fields, and how far apart the eyes see each object.
void add_two_eyes(std::string& text, const DesignReport& report) {
    const StereoSettings& stereo = report.stereo;
    if (!stereo.is_on())
        return;
    std::vector<std::string> lines;
    if (stereo.kind == StereoKind::mirrors)
        lines.push_back(
            fmt::format("the {} eye has the left half of the screen, {} px wide{}; all places and "
                        "angles here are those of a half",
                        stereo.swapped ? "right" : "left", report.display.width_px / 2,
                        stereo.mirrored ? ", both mirrored" : ""));
    else
        lines.emplace_back("each eye has the whole screen in turn, through shutters; untried on hardware");
    lines.push_back(fmt::format("eyes {:g} mm apart", stereo.interocular_mm));
    for (const SurfaceFacts& surface : report.surfaces)
        if (surface.disparity)
            lines.push_back(fmt::format(
                "{}: from {:.1f} arcmin before to {:.1f} arcmin behind the screen's plane", surface.object,
                surface.disparity->nearest_arcmin, surface.disparity->farthest_arcmin));
    add_facts(text, "Two eyes", lines);
}

/// "6 objects x 3 materials", and the other lists where they have several entries.
std::string lists_in_words(const DesignReport& report) {
    std::string words;
    for (const StimulusList& list : stimulus_lists) {
        const auto entries = static_cast<int>(report.factors.at(list.name).levels.size());
        if (list.is_always_named || entries > 1)
            words += (words.empty() ? "" : " x ") + counted(entries, list.name, list.plural);
    }
    return words;
}

/// What is said of the entries besides: "roughness (material): 0.02, 0.05".
void add_columns(std::string& text, const DesignReport& report) {
    std::vector<std::string> lines;
    for (const Factor& factor : report.factors.all()) {
        if (factor.source != Factor::Source::column)
            continue;
        std::string levels;
        for (const FactorLevel& level : factor.levels)
            levels += (levels.empty() ? "" : ", ") + level.name;
        lines.push_back(fmt::format("{} (of {}): {}", factor.name, stimulus_lists[factor.list].name, levels));
    }
    add_facts(text, "Columns", lines);
}

void add_blocks(std::string& text, const DesignReport& report) {
    std::vector<std::string> lines;
    if (!report.blocks.empty()) {
        for (const BlockFacts& block : report.block_facts)
            lines.push_back(fmt::format("{}: {}, {}", block.id, counted(block.trials, "trial"), block.order));
        add_facts(text, "Blocks", lines);
    }
    lines.clear();
    for (const GroupFacts& group : report.groups)
        lines.push_back(fmt::format("{}: {}{}, {} each", group.id, counted(group.observers, "observer"),
                                    group.cap > 0 ? fmt::format(" of {}", group.cap) : "",
                                    counted(group.trials, "trial")));
    add_facts(text, "Groups", lines);
}

/// Each task in each block, in words.
void add_trials(std::string& text, const DesignReport& report) {
    constexpr std::size_t widest = 86;
    std::vector<std::string> lines;
    for (const TaskWords& words : report.trials) {
        std::string line = fmt::format("{}{}: {}, {:.1f} min", words.block.empty() ? "" : words.block + ", ",
                                       words.task, counted(words.trials, "trial"), words.length_s / 60.0);
        for (const std::string& sentence : words.sentences) {
            line += ";";
            if (line.size() + 1 + sentence.size() > widest) {
                lines.push_back(line);
                line = " ";
            }
            line += " " + sentence;
        }
        lines.push_back(line);
    }
    add_facts(text, "Trials", lines);
}

/// Only where several factors go round, for those have to be told apart.
void add_rotations(std::string& text, const DesignReport& report) {
    for (const RotationFacts& group : report.rotations) {
        if (group.tables.empty())
            continue;
        std::string names;
        for (const RotationFacts::Factor& factor : group.factors)
            names +=
                fmt::format("{}{} ({})", names.empty() ? "" : ", ", factor.name, counted(factor.rows, "row"));
        std::vector<std::string> lines{
            (group.group.empty() ? "" : "group " + group.group + ": ") + names,
            fmt::format("all combinations come equally often with {} observers, or a multiple",
                        group.period)};
        for (const CrossTable& table : group.tables) {
            std::string counts;
            for (const std::vector<int>& row : table.observers)
                counts += fmt::format("{}{}", counts.empty() ? "" : " | ", fmt::join(row, " "));
            lines.push_back(fmt::format("observers by {} x {}: {}", table.first, table.second, counts));
        }
        add_facts(text, "Rotations", lines);
    }
}

/// What a motion does in all its frames, as a noun.
std::string_view swings_of(const Animation& motion) {
    return motion.kind == MotionKind::turn || motion.kind == MotionKind::triangle ||
                   motion.kind == MotionKind::trapezoid || motion.kind == MotionKind::still
               ? "swings to and fro"
               : "rounds";
}

/// How object and light move, in words.
std::string movement_of(const Animation& motion) {
    if (motion.kind == MotionKind::observer) {
        const ObserverTurn& by = motion.by_observer;
        const std::string keys = fmt::format("{}", fmt::join(by.keys, ", "));
        const std::string with = by.with == TurnedWith::mouse ? "with the mouse"
                                 : by.with == TurnedWith::keys
                                     ? "with the keys " + keys
                                     : fmt::format("with the mouse and the keys {}", keys);
        const std::string elevations =
            by.has_elevations()
                ? fmt::format(
                      "; tilted from {} to {} deg, {} deg from pose to pose: {} turns at {} elevations",
                      by.elevation_from.value, by.elevation_to.value, by.elevation_step.value,
                      by.turn_count(), by.elevation_count())
                : std::string();
        return fmt::format("turned by the observer {}, {} deg from pose to pose, {}{}", with, by.step.value,
                           by.is_whole() ? std::string("all round")
                                         : fmt::format("from {} to {} deg", by.from.value, by.to.value),
                           elevations);
    }
    std::string words = motion.kind == MotionKind::still ? fmt::format("still at {} deg", motion.angle.value)
                                                         : way_of(motion);
    if (motion.kind == MotionKind::turn && motion.angle.value != 0.0)
        words += fmt::format(" of {}", motion.angle.value);
    else if (motion.kind != MotionKind::still && motion.angle.value != 0.0)
        words += fmt::format(", from {} deg", motion.angle.value);
    if (motion.axis || motion.pivot)
        words += ", about an axis of its own";
    if (const std::string light = way_of_light(motion); !light.empty())
        words += fmt::format(", the light {}", light);
    return words;
}

/// What a motion shows again: "courses of P01 session 1 (20 trials, 3.1 … 8.0 s) and …".
std::string recordings_of(const AnimationFacts& animation) {
    std::vector<std::string> recordings;
    for (const auto& one : animation.recordings)
        recordings.push_back(fmt::format("{} ({}, {:.3f} … {:.3f} s)", one.whose,
                                         counted(one.trials, "trial"), one.shortest_s, one.longest_s));
    return fmt::format("shown again: {}; {}{}", fmt::join(recordings, ", "),
                       animation.motion.matched_by == CourseMatch::trial
                           ? "each trial that of its number"
                           : "each trial one with the same stimulus in the same slot",
                       recordings.size() > 1 ? "; observers have them in turn, by their numbers" : "");
}

void add_motion(std::string& text, const DesignReport& report, const AnimationFacts& animation) {
    const bool is_one_of_several = report.motions.size() > 1;
    const bool moves = animation.distinct_poses > 1 || animation.motion.moves();
    add_facts(text, is_one_of_several ? "Motion" : "Animation",
              {fmt::format("{}{} ({}), {}, {}", is_one_of_several ? animation.id + ": " : "",
                           counted(animation.frames, "frame"), name_of(animation.motion.playback),
                           counted(animation.distinct_poses, "distinct pose"), movement_of(animation.motion)),
               animation.motion.kind == MotionKind::recorded ? recordings_of(animation)
               : animation.motion.kind == MotionKind::observer
                   ? fmt::format("shown: {:.3f} s, in the poses that it is turned to", animation.duration_s)
               : moves ? fmt::format("shown: {} at {:.6g} Hz = {:.3f} s = {:.4g} {}",
                                     counted(animation.shown_frames, "frame"),
                                     animation.shown_frames / animation.duration_s, animation.duration_s,
                                     animation.periods, swings_of(animation.motion))
                       : fmt::format("shown: {:.3f} s", animation.duration_s),
               fmt::format("each frame is lit for {} at {} Hz: {} refreshes{}",
                           counted(animation.refreshes_per_frame, "refresh", "refreshes"),
                           report.display.refresh_hz, animation.refreshes,
                           difference_of_rates(report, animation))});
}

/// "7.98 deg to the left of the screen's middle and 2.00 deg above it".
std::string from_the_middle(double right_deg, double up_deg) {
    constexpr double least_deg = 0.005; // what is written as 0.00
    std::string words;
    if (std::abs(right_deg) >= least_deg)
        words =
            fmt::format("{:.2f} deg to the {} of", std::abs(right_deg), right_deg > 0.0 ? "right" : "left");
    const std::string height =
        fmt::format("{:.2f} deg {}", std::abs(up_deg), up_deg > 0.0 ? "above" : "below");
    if (std::abs(up_deg) < least_deg)
        return (words.empty() ? "in" : words) + " the screen's middle";
    return words.empty() ? height + " the screen's middle"
                         : words + " the screen's middle, " + height + " it";
}

void add_overview(std::string& text, const DesignReport& report) {
    const int tasks = static_cast<int>(report.tasks.size());
    const int stimuli = static_cast<int>(report.factors.stimulus_count());
    const VisualAngles& angles = report.angles;
    add_facts(
        text, "Design",
        {fmt::format("{} = {}; {}: {}", lists_in_words(report), counted(stimuli, "stimulus", "stimuli"),
                     counted(tasks, "task"), counted(tasks * stimuli, "map")),
         fmt::format("{}{} for each of {}",
                     report.fewest_trials < report.trials_per_observer
                         ? fmt::format("{} to ", report.fewest_trials)
                         : "",
                     counted(report.trials_per_observer, "trial"), counted(report.observers, "observer"))});
    add_columns(text, report);
    add_blocks(text, report);
    add_trials(text, report);
    add_rotations(text, report);
    for (const AnimationFacts& animation : report.motions)
        add_motion(text, report, animation);
    add_facts(
        text, "Screen",
        {fmt::format("{} x {} px, {} x {} mm, seen from {} mm: {:.2f} x {:.2f} deg", report.display.width_px,
                     report.display.height_px, report.display.width_mm, report.display.height_mm,
                     report.display.viewing_distance_mm, angles.screen_width_deg, angles.screen_height_deg) +
             (report.stereo.kind == StereoKind::mirrors ? " each half" : ""),
         fmt::format("light leaves as {}", name_of(report.display.output))});
    add_two_eyes(text, report);
    std::vector<std::string> places;
    for (const DesignReport::SlotFacts& slot : report.slot_places) {
        const glm::ivec2 first = slot.screen.image_origin_px, last = first + slot.screen.image_px - 1;
        const glm::dvec2 middle = slot.screen.middle_deg();
        const glm::dvec2 size = slot_size_deg(slot.screen);
        places.push_back(fmt::format("{}: {:.2f} x {:.2f} deg, {}; columns {} to {}, rows {} to {}", slot.id,
                                     size.x, size.y, from_the_middle(middle.x, middle.y), first.x, last.x,
                                     first.y, last.y));
    }
    const bool has_sizes = std::ranges::any_of(report.slot_places, [&](const DesignReport::SlotFacts& slot) {
        return slot.screen.image_px != report.slot_places.front().screen.image_px;
    });
    if (!places.empty())
        add_facts(text, "Slots", places);
    if (const auto& light = report.display.characterisation) {
        std::vector<std::string> lines = light_lines(*light);
        lines.push_back(fmt::format("measured {} with {}; background {:.4g} cd/m2",
                                    light->date.empty() ? "at no stated time" : light->date,
                                    light->instrument.empty() ? "no stated instrument" : light->instrument,
                                    light->luminance_of(report.display.background)));
        add_facts(text, "Light", lines);
    }
    std::vector<std::string> stimulus{
        fmt::format("{} x {} px: {:.2f} x {:.2f} deg, {:.1f} px per degree at the screen's middle{}",
                    report.view.width_px, report.view.height_px, angles.image_width_deg,
                    angles.image_height_deg, angles.px_per_deg,
                    has_sizes ? fmt::format("; this and the next is in \"{}\"", report.slot_places.front().id)
                              : ""),
        fmt::format("rendered under {:.2f} deg", angles.camera_fov_deg)};
    if (report.slot_places.empty() &&
        std::hypot(angles.image_right_deg, angles.image_up_deg) > 2.0 / angles.px_per_deg)
        stimulus.push_back(
            fmt::format("it stands {}", from_the_middle(angles.image_right_deg, angles.image_up_deg)));
    add_facts(text, "Stimulus", stimulus);
    const MemoryNeed& memory = report.memory;
    add_facts(
        text, "Memory",
        {memory.streamed_pages_kept > 0
             ? fmt::format("{} of frames for a stimulus; {} are kept on the graphics card, the others come "
                           "from disk while it is shown (frame_store_mb = {})",
                           in_bytes(memory.pages_per_stimulus_bytes),
                           counted(memory.streamed_pages_kept, "picture"), report.display.frame_store_mb)
         : memory.next_fits
             ? fmt::format("{} of frames for a stimulus, {} on the graphics card with those of the next",
                           in_bytes(memory.pages_per_stimulus_bytes), in_bytes(memory.pages_at_once_bytes()))
             : fmt::format("{} of frames for a stimulus; those of the next do not fit beside them, and "
                           "are loaded before its trial (frame_store_mb = {})",
                           in_bytes(memory.pages_per_stimulus_bytes), report.display.frame_store_mb),
         fmt::format("{} of maps for each object", in_bytes(memory.maps_per_object_bytes))});
    if (report.recording)
        add_facts(text, "Disk",
                  {fmt::format("a session takes about {}", to_text(*report.recording)),
                   fmt::format("all {1} about {0}", in_bytes(report.observers * report.recording->total()),
                               counted(report.observers, "observer"))});
}

void add_surfaces(std::string& text, const DesignReport& report) {
    std::vector<std::string> lines;
    for (const SurfaceFacts& surface : report.surfaces) {
        std::string parts;
        for (const auto& [name, share] : surface.part_shares)
            parts += fmt::format("{} {:.1f} % {}", parts.empty() ? ":" : ",", 100.0 * share, name);
        lines.push_back(fmt::format("{}, {} triangles{}", surface.object, surface.triangles, parts));
        const ObjectSize& size = surface.size;
        const std::string_view unit = size.unit == "own" ? "of its own unit" : "mm";
        lines.push_back(
            fmt::format("  {:.4g} {} high and {:.4g} wide; shown {:.4g} mm ({:.3g} deg) high and {:.4g} mm "
                        "({:.3g} deg) wide",
                        size.object.z, unit, size.object.x, size.shown_mm.y, size.shown_deg.y,
                        size.shown_mm.x, size.shown_deg.x));
    }
    add_facts(text, "Surface", lines);
}

void add_session(std::string& text, const DesignReport& report) {
    const SessionLength& session = report.session;
    const auto minutes = [](double seconds) { return fmt::format("{:.1f}", seconds / 60.0); };
    add_facts(
        text, "Session",
        {fmt::format(
             "about {:.0f} min: calibration {}, questions {}, drift checks {}, animations {}, answers {}",
             session.total_s() / 60.0, minutes(session.calibration_s), minutes(session.questions_s),
             minutes(session.drift_checks_s), minutes(session.animations_s), minutes(session.answers_s)),
         fmt::format("if reading takes {} s and answering {} s", report.assumptions.question_s,
                     report.assumptions.answer_s)});
    if (session.practice_s + session.breaks_s + session.instructions_s > 0.0)
        add_facts(text, "",
                  {fmt::format("with {} of practice, {} of instructions, and {} in {}",
                               minutes(session.practice_s), minutes(session.instructions_s),
                               minutes(session.breaks_s), counted(session.breaks, "break"))});
}

/// Where stimuli differ in more than object and material: for each task and factor, how often each level is
/// shown.
void add_balance_by_factor(std::string& text, const DesignReport& report) {
    text += fmt::format("\nPresentations of each level over {}\n\n", counted(report.observers, "observer"));
    std::size_t width = 0;
    for (const Factor& factor : report.factors.all())
        width = std::max(width, factor.name.size());
    for (int task = 0; task < static_cast<int>(report.tasks.size()); ++task) {
        text += fmt::format("  {}\n", at(report.tasks, task));
        for (const Factor& factor : report.factors.all()) {
            const bool is_of_stimuli =
                factor.source == Factor::Source::list || factor.source == Factor::Source::column;
            if (!is_of_stimuli || factor.levels.size() < 2)
                continue;
            std::vector<int> shown(factor.levels.size());
            for (const IncidenceCell& cell : report.incidence)
                if (cell.task == task)
                    shown[static_cast<std::size_t>(report.factors.level_of(factor, {}, cell.stimulus))] +=
                        cell.presentations;
            std::string levels;
            for (std::size_t level = 0; level < shown.size(); ++level)
                levels += fmt::format("{}{} {}", levels.empty() ? "" : ", ", factor.levels[level].name,
                                      shown[level]);
            text += fmt::format("    {:<{}}  {}\n", factor.name, width, levels);
        }
    }
}

/// Where stimuli are objects in materials: how often each is shown.
void add_balance_by_stimulus(std::string& text, const DesignReport& report) {
    text +=
        fmt::format("\nPresentations of each stimulus over {}\n\n", counted(report.observers, "observer"));
    const std::size_t task_width = longest(report.tasks);
    const std::size_t cell_width = std::max<std::size_t>(4, longest(report.materials));
    const std::size_t group_width = (cell_width + 1) * report.materials.size();
    std::string groups, cells;
    for (const std::string& object : report.objects) {
        groups += fmt::format("  {:<{}}", object, std::max(group_width, object.size()) - 1);
        cells += " ";
        for (const std::string& material : report.materials)
            cells += fmt::format(" {:>{}}", material, cell_width);
        cells.append(std::max(group_width, object.size()) - group_width, ' ');
    }
    groups.erase(groups.find_last_not_of(' ') + 1);
    cells.erase(cells.find_last_not_of(' ') + 1);
    const std::string margin(task_width + 2, ' ');
    text += fmt::format("{} {}\n{} {}\n", margin, groups, margin, cells);
    std::size_t next = 0;
    for (const std::string& task : report.tasks) {
        text += fmt::format("  {:<{}} ", task, task_width);
        for (const std::string& object : report.objects) {
            text += " ";
            for (std::size_t material = 0; material < report.materials.size(); ++material)
                text += fmt::format(" {:>{}}", report.incidence[next++].presentations, cell_width);
            text.append(std::max(group_width, object.size()) - group_width, ' ');
        }
        text += "\n";
    }
}

void add_balance(std::string& text, const DesignReport& report) {
    if (report.factors.stimulus_count() == report.objects.size() * report.materials.size())
        add_balance_by_stimulus(text, report);
    else
        add_balance_by_factor(text, report);
}

/// Lists by which the stimuli of an order are named.
std::vector<const StimulusList*> named_lists(const DesignReport& report) {
    std::vector<const StimulusList*> lists;
    for (const StimulusList& list : stimulus_lists)
        if (list.is_always_named || report.factors.at(list.name).levels.size() > 1)
            lists.push_back(&list);
    return lists;
}

const std::string& id_in(const DesignReport& report, const StimulusList& list, const Stimulus& stimulus) {
    return report.factors.at(list.name).levels.at(static_cast<std::size_t>(stimulus.*list.index)).name;
}

void add_order_of_one(std::string& text, const DesignReport& report, const Schedule& schedule) {
    const std::size_t task_width = longest(report.tasks);
    for (const Trial& trial : schedule.trials) {
        const bool begins_block =
            !report.blocks.empty() &&
            (trial.index == 0 ||
             schedule.trials[static_cast<std::size_t>(trial.index) - 1].block != trial.block);
        if (begins_block)
            text += fmt::format("  block {}\n", at(report.blocks, trial.block));
        std::string line =
            fmt::format("  {:>4}  {:<{}}", trial.index + 1, at(report.tasks, trial.task), task_width);
        for (const PlacedStimulus& shown : trial.all_shown()) {
            if (report.slots.size() > 1)
                line += fmt::format("  {}:", at(report.slots, shown.slot));
            for (const StimulusList* list : named_lists(report)) {
                std::size_t width = 0;
                for (const FactorLevel& level : report.factors.at(list->name).levels)
                    width = std::max(width, level.name.size());
                line += fmt::format("  {:<{}}", id_in(report, *list, shown.stimulus), width);
            }
        }
        for (const TrialLevel& of : trial.levels)
            line += fmt::format("  {} {}", of.factor, of.level);
        if (!trial.correct.empty())
            line += fmt::format("  correct {}", trial.correct);
        if (trial.role != TrialRole::trial)
            line += fmt::format("  ({})", name_of(trial.role));
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
}

/// Position in a list as a letter, or a number where letters run out.
std::string letter(char first, int index) {
    return index < 26 ? std::string(1, static_cast<char>(first + index)) : fmt::format("({})", index + 1);
}

std::string legend(const std::vector<std::string>& names, char first) {
    std::string text;
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        const std::string code = first == '1' ? fmt::format("{}", i + 1) : letter(first, i);
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", code, at(names, i));
    }
    return text;
}

void add_orders_of_many(std::string& text, const DesignReport& report) {
    constexpr int codes_per_line = 18;
    text += fmt::format("  task: {}\n", legend(report.tasks, '1'));
    // Letters of one list and the next can be told apart: capitals and small ones take turns.
    std::vector<const StimulusList*> lists = named_lists(report);
    for (std::size_t i = 0; i < lists.size(); ++i) {
        std::vector<std::string> ids;
        for (const FactorLevel& level : report.factors.at(lists[i]->name).levels)
            ids.push_back(level.name);
        text += fmt::format("  {}: {}\n", lists[i]->name, legend(ids, i % 2 == 0 ? 'A' : 'a'));
    }
    text += "\n";
    for (const Schedule& schedule : report.schedules) {
        std::string line;
        for (const Trial& trial : schedule.trials) {
            const bool begins_block =
                trial.index > 0 &&
                schedule.trials[static_cast<std::size_t>(trial.index) - 1].block != trial.block;
            if (begins_block)
                line += " |";
            if (trial.index > 0 && trial.index % codes_per_line == 0)
                line += "\n          ";
            line += fmt::format(" {}", trial.task + 1);
            for (std::size_t i = 0; i < lists.size(); ++i)
                line += letter(i % 2 == 0 ? 'A' : 'a', trial.stimulus.*lists[i]->index);
        }
        const auto index = static_cast<std::size_t>(&schedule - report.schedules.data());
        const std::string group =
            report.schedule_groups.empty() ? "" : fmt::format("  ({})", report.schedule_groups[index]);
        text += fmt::format("  {:>6}: {}{}\n", schedule.observer.label, line, group);
    }
}

void add_orders(std::string& text, const DesignReport& report) {
    if (report.schedules.empty())
        return;
    const std::string seed = report.is_seed_fixed ? fmt::format("seed {}", report.schedules.front().seed)
                             : report.is_seed_given
                                 ? fmt::format("as from seed {}", report.schedules.front().seed)
                                 : fmt::format("an example, from seed {}: each session draws its own",
                                               report.schedules.front().seed);
    if (report.schedules.size() == 1) {
        text += fmt::format("\nOrder of trials for observer {} ({})\n\n",
                            report.schedules.front().observer.label, seed);
        add_order_of_one(text, report, report.schedules.front());
    } else {
        text += fmt::format("\nOrder of trials ({})\n\n", seed);
        add_orders_of_many(text, report);
    }
}

} // namespace

std::string to_text(const DesignReport& report) {
    std::string text = report.title == report.name ? report.name + "\n\n"
                                                   : fmt::format("{} ({})\n\n", report.title, report.name);
    add_overview(text, report);
    add_surfaces(text, report);
    add_session(text, report);
    add_balance(text, report);
    for (const std::string& warning : report.warnings)
        text += fmt::format("\nwarning: {}\n", warning);
    add_orders(text, report);
    return text;
}

} // namespace overt
