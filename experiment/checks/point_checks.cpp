#include "experiment/checks/protocol_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/point_trials.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/stimulus/object_points.h"

namespace overt {

namespace {

/// Marks beside a gauge, which is one, too.
constexpr std::size_t most_probes = 4;
/// More trials than anyone has; a bound for what is put together before any is drawn.
constexpr std::size_t most_combinations = 200000;

void check_point_list(ProtocolExamination& examination, std::size_t index) {
    const Protocol& protocol = examination.protocol;
    const PointListSettings& list = protocol.point_lists[index];
    const auto at = [&](std::string_view key) { return fmt::format("points[{}].{}", index, key); };
    if (!list.object.empty())
        (void)is_known(examination, at("object"), "object", list.object, ids_in_list(protocol, 0));
    const bool is_given = !list.vertices.empty() || !list.places.empty() || !list.near_mm.empty();
    if (list.evenly && is_given)
        examination.error(
            {at("vertices"), at("places"), at("near_mm")},
            fmt::format("the places of \"{}\" are given one by one, and spread evenly", list.id),
            "make two lists of them");
    if (!list.evenly && !is_given)
        examination.error({at("id")}, fmt::format("nothing says where the places of \"{}\" are", list.id),
                          "write evenly = 40, vertices, places or near_mm");
    for (const std::string_view key : {"area", "facing_deg", "seed", "frame"})
        if (!list.evenly && examination.is_written(at(key)))
            examination.error(
                {at(key)}, fmt::format("\"{}\" is of places that are spread, and those of \"{}\" are given",
                                       key, list.id));
    if (examination.is_written(at("frame")) && !list.facing_deg)
        examination.error({at("frame")}, "nothing asks what is seen in a frame", "write facing_deg = 60");
    if (!protocol.motions.empty() && list.frame >= protocol.motions.front().frame_count)
        examination.error(
            {at("frame")}, fmt::format("there is no frame {}", list.frame),
            fmt::format("the first motion has frames 0 to {}", protocol.motions.front().frame_count - 1));
    const bool is_of_one_mesh = !list.vertices.empty() || !list.places.empty();
    if (is_of_one_mesh && list.object.empty() && protocol.objects.size() > 1)
        examination.error(
            {at("vertices"), at("places")},
            fmt::format("numbers of vertices and triangles are of one mesh, and \"{}\" does not "
                        "say of which",
                        list.id),
            fmt::format("write object = \"{}\"", protocol.objects.front().id));
    for (const double vertex : list.vertices)
        if (vertex != std::floor(vertex))
            examination.error({at("vertices")}, fmt::format("{:g} is no number of a vertex", vertex));
}

/// Lists of one id are of different objects, and as long: their places correspond by their numbers.
void check_corresponding_lists(ProtocolExamination& examination) {
    const std::vector<PointListSettings>& lists = examination.protocol.point_lists;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        const auto first = std::ranges::find(lists, lists[i].id, &PointListSettings::id);
        if (first == lists.begin() + static_cast<std::ptrdiff_t>(i))
            continue;
        const auto same = std::find_if(
            first, lists.begin() + static_cast<std::ptrdiff_t>(i), [&](const PointListSettings& other) {
                return other.id == lists[i].id &&
                       (other.object.empty() || lists[i].object.empty() || other.object == lists[i].object);
            });
        const std::string at = fmt::format("points[{}].id", i);
        if (same != lists.begin() + static_cast<std::ptrdiff_t>(i))
            examination.error({at}, fmt::format("the id \"{}\" is there twice", lists[i].id),
                              "lists of one id, whose places correspond, are each of another object: write "
                              "object in all of them, or call this one otherwise");
        else if (first->evenly || lists[i].evenly)
            examination.error(
                {at},
                fmt::format("the places of \"{}\" on several objects correspond, and places that "
                            "are spread evenly do not",
                            lists[i].id),
                "give them one by one, or call this list otherwise");
        else if (first->count() != lists[i].count())
            examination.error(
                {at}, fmt::format("\"{}\" has {} on \"{}\" and {} on \"{}\": places of one id correspond "
                                  "by their numbers",
                                  lists[i].id, counted(first->count(), "place"), first->object,
                                  lists[i].count(), lists[i].object));
    }
}

/// Of one task.
class ProbeChecks {
  public:
    ProbeChecks(ProtocolExamination& examination, std::size_t task)
        : examination_(examination), protocol_(examination.protocol), number_(task),
          task_(protocol_.tasks[task]) {}

    void run() {
        if (examination_.is_written(fmt::format("task[{}].draw_points", number_)) && task_.probes.empty())
            examination_.error({fmt::format("task[{}].draw_points", number_)},
                               fmt::format("task {} has no probe whose places could be drawn", task_.id),
                               "add a [[task.probe]]");
        for (const StepSettings& step : task_.steps)
            check_step(step);
        if (task_.probes.empty())
            return;
        if (task_.probes.size() > most_probes)
            examination_.error({at(most_probes, "id")},
                               fmt::format("a task has up to {} probes", most_probes));
        std::vector<std::string_view> ids;
        for (std::size_t i = 0; i < task_.probes.size(); ++i) {
            check_id(i, ids);
            check_probe(i);
        }
        check_lists();
        check_tables();
    }

    /// Whether the objects that are shown are those of the lists. Of a protocol that is sound otherwise.
    void check_objects() {
        std::set<std::pair<std::size_t, int>> told;
        for (const BlockPlan& plan : block_plans(protocol_, 1, 0))
            for (const Trial& trial : plan.trials)
                for (std::size_t i = 0; i < task_.probes.size() && trial.task == static_cast<int>(number_);
                     ++i)
                    if (const int object = object_at(trial, task_.probes[i]);
                        object >= 0 && !is_on(i, object) && told.emplace(i, object).second)
                        examination_.error(
                            {at(i, "points")},
                            fmt::format(
                                "task {} shows object \"{}\", and the places of \"{}\" are on another",
                                task_.id, protocol_.objects[static_cast<std::size_t>(object)].id,
                                task_.probes[i].points),
                            "have a block show the one object, or leave object out of the [[points]]");
    }

  private:
    std::string at(std::size_t probe, std::string_view key) const {
        return fmt::format("task[{}].probe[{}].{}", number_, probe, key);
    }
    void check_id(std::size_t i, std::vector<std::string_view>& ids) {
        const std::string& id = task_.probes[i].id;
        if (std::ranges::find(ids, id) != ids.end())
            examination_.error({at(i, "id")}, fmt::format("probe \"{}\" is there twice", id));
        ids.push_back(id);
        const Factors factors = factors_of(protocol_);
        const Factor* const same = factors.find(id);
        if (is_name_of_factor(id) || (same && same->source != Factor::Source::own))
            examination_.error(
                {at(i, "id")},
                fmt::format("tables have a column \"{}\" already, and the probe's is called by "
                            "its id",
                            id),
                "call it otherwise");
    }

    void check_probe(std::size_t i) {
        const ProbeSettings& probe = task_.probes[i];
        (void)is_known(examination_, at(i, "points"), "list of [[points]]", probe.points,
                       ids_of_views(protocol_.point_lists));
        const std::vector<int> slots = slots_of_task(protocol_, static_cast<int>(number_));
        std::vector<std::string_view> ids;
        for (const int slot : slots)
            ids.push_back(protocol_.slots[static_cast<std::size_t>(slot)].id);
        if (probe.slot.empty() && slots.size() > 1)
            examination_.error(
                {at(i, "id")},
                fmt::format("task {} shows stimuli in {} slots, and nothing says in which probe "
                            "\"{}\" stands",
                            task_.id, slots.size(), probe.id),
                fmt::format("write slot = \"{}\"", ids.front()));
        if (!probe.slot.empty())
            (void)is_known(examination_, at(i, "slot"), fmt::format("slot of task {}", task_.id), probe.slot,
                           ids);
        for (const std::string_view key : {"line_deg"})
            if (probe.mark != ProbeMark::ring && examination_.is_written(at(i, key)))
                examination_.error({at(i, key)}, fmt::format("\"{}\" is of a ring", key),
                                   "write mark = \"ring\"");
    }

    void check_lists() {
        std::map<std::string, int> probes_of;
        for (const ProbeSettings& probe : task_.probes)
            ++probes_of[probe.points];
        for (const auto& [id, count] : probes_of) {
            const PointListSettings* const list = point_list(protocol_, id);
            if (list && list->count() < count)
                examination_.error({at(0, "points")},
                                   fmt::format("{} stand at different places of \"{}\", which has {}",
                                               counted(count, "probe"), id, list->count()));
        }
        const std::size_t ways = point_combinations(protocol_, task_, most_combinations);
        if (ways >= most_combinations)
            examination_.error({at(0, "points")},
                               fmt::format("the probes of task {} have places in {} ways and more", task_.id,
                                           most_combinations),
                               "make shorter lists");
        else if (task_.draw_points && static_cast<std::size_t>(*task_.draw_points) > ways)
            examination_.error({fmt::format("task[{}].draw_points", number_)},
                               fmt::format("of {} nothing like {} can be drawn",
                                           counted(static_cast<int>(ways), "place or set of places",
                                                   "places or sets of places"),
                                           *task_.draw_points),
                               "leave it out for all");
    }

    /// Columns of tables that are called as probes say their places.
    void check_tables() {
        for (const int table : {task_.trials.table, task_.catch_trials.table}) {
            if (table < 0)
                continue;
            const TrialTable& of = protocol_.trial_tables[static_cast<std::size_t>(table)];
            for (const ProbeSettings& probe : task_.probes) {
                const PointListSettings* const list = point_list(protocol_, probe.points);
                std::set<std::string> names;
                for (int i = 0; list && i < list->count(); ++i)
                    names.insert(list->name_of(i));
                for (const TrialTableRow& row : of.rows) {
                    const std::string level(level_in(row, probe.id));
                    if (list && !level.empty() && !names.contains(level)) {
                        examination_.error(
                            {at(0, "points")},
                            fmt::format("{}: \"{}\" is no place of \"{}\"", of.file, level, probe.points),
                            fmt::format("places are {} to {}", list->name_of(0),
                                        list->name_of(list->count() - 1)));
                        break;
                    }
                }
            }
        }
    }

    void check_step(const StepSettings& step) {
        std::vector<std::string_view> ids;
        for (const ProbeSettings& probe : task_.probes)
            ids.push_back(probe.id);
        for (const std::string& id : step.probes.value_or(std::vector<std::string>()))
            if (std::ranges::find(ids, id) == ids.end())
                examination_.diagnostics().error(protocol_.file.string(), step.probes_place,
                                                 fmt::format("task {} has no probe \"{}\"", task_.id, id),
                                                 ids.empty() ? "add a [[task.probe]] below the task"
                                                             : suggest_name(id, ids));
    }

    /// Index of the object on which a probe stands; -1: its slot is empty.
    int object_at(const Trial& trial, const ProbeSettings& probe) const {
        for (std::size_t i = 0; i < trial.shown_count(); ++i) {
            const auto [stimulus, slot] = trial.shown(i);
            if (probe.slot.empty() || protocol_.slots[static_cast<std::size_t>(slot)].id == probe.slot)
                return stimulus.object;
        }
        return -1;
    }
    bool is_on(std::size_t probe, int object) const {
        const std::string& id = task_.probes[probe].points;
        const auto is_there = [&](const PointListSettings& list) {
            return list.id == id && is_on_object(protocol_, list, static_cast<std::size_t>(object));
        };
        return !point_list(protocol_, id) || std::ranges::any_of(protocol_.point_lists, is_there);
    }

    static std::vector<std::string_view> ids_of_views(const std::vector<PointListSettings>& lists) {
        std::vector<std::string_view> ids;
        for (const PointListSettings& list : lists)
            ids.push_back(list.id);
        return ids;
    }

    ProtocolExamination& examination_;
    const Protocol& protocol_;
    std::size_t number_;
    const Task& task_;
};

} // namespace

void check_points(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    check_corresponding_lists(examination);
    for (std::size_t i = 0; i < protocol.point_lists.size(); ++i)
        check_point_list(examination, i);
    for (std::size_t task = 0; task < protocol.tasks.size(); ++task)
        ProbeChecks(examination, task).run();
}

void check_points_on_objects(ProtocolExamination& examination) {
    for (std::size_t task = 0; task < examination.protocol.tasks.size(); ++task)
        if (!examination.protocol.tasks[task].probes.empty())
            ProbeChecks(examination, task).check_objects();
}

} // namespace overt
