#include <cmath>

#include <nlohmann/json.hpp>

#include "experiment/checks/design_report.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

/// A member for each list that has several entries or is always named.
void add_stimulus(Json& item, const DesignReport& report, const Stimulus& stimulus) {
    for (const StimulusList& list : stimulus_lists) {
        const Factor& factor = report.factors.at(list.name);
        if (list.is_always_named || factor.levels.size() > 1)
            item[factor.name] = factor.levels.at(static_cast<std::size_t>(stimulus.*list.index)).name;
    }
}

Json order_json(const DesignReport& report, std::size_t index) {
    const Schedule& schedule = report.schedules[index];
    Json trials = Json::array();
    for (const Trial& trial : schedule.trials) {
        Json item{{"trial", trial.index + 1}};
        if (!report.blocks.empty())
            item["block"] = report.blocks.at(static_cast<std::size_t>(trial.block));
        item["task"] = report.tasks.at(static_cast<std::size_t>(trial.task));
        add_stimulus(item, report, trial.stimulus);
        if (report.slots.size() > 1) {
            for (const PlacedStimulus& shown : trial.all_shown()) {
                Json in_slot{{"slot", report.slots.at(static_cast<std::size_t>(shown.slot))}};
                add_stimulus(in_slot, report, shown.stimulus);
                item["shown"].push_back(std::move(in_slot));
            }
        }
        for (const TrialLevel& of : trial.levels)
            item["levels"][of.factor] = of.level;
        if (!trial.correct.empty())
            item["correct"] = trial.correct;
        if (trial.role != TrialRole::trial)
            item["role"] = name_of(trial.role);
        trials.push_back(std::move(item));
    }
    Json order{{"observer", schedule.observer.label},
               {"number", schedule.observer.number},
               {"seed", schedule.seed},
               {"evenly_drawn", schedule.is_even}};
    if (!report.schedule_groups.empty())
        order["group"] = report.schedule_groups.at(index);
    order["trials"] = std::move(trials);
    return order;
}

Json factors_json(const Factors& factors) {
    Json json = Json::array();
    for (const Factor& factor : factors.all()) {
        if (factor.levels.size() < 2)
            continue;
        Json levels = Json::array();
        for (const FactorLevel& level : factor.levels)
            levels.push_back(level.number ? Json(*level.number) : Json(level.name));
        json.push_back({{"factor", factor.name}, {"levels", std::move(levels)}});
    }
    return json;
}

Json blocks_json(const DesignReport& report) {
    Json blocks = Json::array();
    if (report.blocks.empty())
        return blocks;
    for (const BlockFacts& block : report.block_facts)
        blocks.push_back({{"block", block.id}, {"order", block.order}, {"trials", block.trials}});
    return blocks;
}

Json groups_json(const DesignReport& report) {
    Json groups = Json::array();
    for (const GroupFacts& group : report.groups) {
        groups.push_back({{"group", group.id}, {"observers", group.observers}, {"trials", group.trials}});
        if (group.cap > 0)
            groups.back()["cap"] = group.cap;
    }
    return groups;
}

Json rotations_json(const DesignReport& report) {
    Json groups = Json::array();
    for (const RotationFacts& group : report.rotations) {
        Json factors = Json::array(), tables = Json::array();
        for (const RotationFacts::Factor& factor : group.factors)
            factors.push_back({{"name", factor.name}, {"rows", factor.rows}});
        for (const CrossTable& table : group.tables)
            tables.push_back(
                {{"first", table.first}, {"second", table.second}, {"observers", table.observers}});
        groups.push_back({{"group", group.group},
                          {"observers", group.observers},
                          {"factors", factors},
                          {"period", group.period},
                          {"cross_tables", tables}});
    }
    return groups;
}

Json motion_json(const AnimationFacts& motion) {
    Json recordings = Json::array();
    for (const AnimationFacts::Recording& one : motion.recordings)
        recordings.push_back({{"whose", one.whose},
                              {"trials", one.trials},
                              {"shortest_s", one.shortest_s},
                              {"longest_s", one.longest_s}});
    return {{"id", motion.id},
            {"kind", name_of(motion.motion.kind)},
            {"frames", motion.frames},
            {"distinct_poses", motion.distinct_poses},
            {"shown_frames", motion.shown_frames},
            {"refreshes_per_frame", motion.refreshes_per_frame},
            {"refreshes", motion.refreshes},
            {"duration_s", motion.duration_s},
            {"periods", motion.periods},
            {"amplitude_deg", motion.motion.amplitude.value},
            {"angle_deg", motion.motion.angle.value},
            {"light_amplitude_deg", motion.motion.light_amplitude.value},
            {"playback", name_of(motion.motion.playback)},
            {"recordings", recordings}};
}

} // namespace

Json to_json(const DesignReport& report) {
    const VisualAngles& angles = report.angles;
    const SessionLength& session = report.session;
    Json json{{"name", report.name},
              {"title", report.title},
              {"tasks", report.tasks},
              {"objects", report.objects},
              {"materials", report.materials},
              {"trials_per_observer", report.trials_per_observer},
              {"fewest_trials", report.fewest_trials},
              {"observers", report.observers},
              {"practice_trials", report.practice_trials}};
    json["factors"] = factors_json(report.factors);
    json["blocks"] = blocks_json(report);
    json["trials"] = to_json(report.trials);
    json["groups"] = groups_json(report);
    json["animation"] = motion_json(report.motions.front());
    json["motions"] = Json::array();
    for (const AnimationFacts& motion : report.motions)
        json["motions"].push_back(motion_json(motion));
    json["angles"] = {
        {"screen_width_deg", angles.screen_width_deg}, {"screen_height_deg", angles.screen_height_deg},
        {"image_width_deg", angles.image_width_deg},   {"image_height_deg", angles.image_height_deg},
        {"image_right_deg", angles.image_right_deg},   {"image_up_deg", angles.image_up_deg},
        {"camera_fov_deg", angles.camera_fov_deg},     {"px_per_deg", angles.px_per_deg}};
    if (const auto& light = report.display.characterisation) {
        const auto numbers = [](const glm::dvec3& xyz) { return Json{xyz.x, xyz.y, xyz.z}; };
        const glm::dvec3 white = light->white_xyz();
        json["light"] = {{"display", light->display},
                         {"date", light->date},
                         {"sha256", light->sha256},
                         {"white_cd_m2", white.y},
                         {"black_cd_m2", light->black_xyz.y},
                         {"background_cd_m2", light->luminance_of(report.display.background)},
                         {"white_xyz", numbers(white)},
                         {"black_xyz", numbers(light->black_xyz)},
                         {"red_xyz", numbers(light->primaries_xyz[0])},
                         {"green_xyz", numbers(light->primaries_xyz[1])},
                         {"blue_xyz", numbers(light->primaries_xyz[2])}};
        if (std::isfinite(light->contrast()))
            json["light"]["contrast"] = light->contrast();
    }
    for (const DesignReport::SlotFacts& slot : report.slot_places)
        json["slots"].push_back({{"id", slot.id},
                                 {"left_px", slot.screen.image_origin_px.x},
                                 {"top_px", slot.screen.image_origin_px.y},
                                 {"width_px", slot.screen.image_px.x},
                                 {"height_px", slot.screen.image_px.y},
                                 {"right_deg", slot.screen.middle_deg().x},
                                 {"up_deg", slot.screen.middle_deg().y}});
    json["session"] = {{"calibration_s", session.calibration_s},
                       {"questions_s", session.questions_s},
                       {"drift_checks_s", session.drift_checks_s},
                       {"animations_s", session.animations_s},
                       {"answers_s", session.answers_s},
                       {"practice_s", session.practice_s},
                       {"instructions_s", session.instructions_s},
                       {"breaks_s", session.breaks_s},
                       {"breaks", session.breaks},
                       {"total_s", session.total_s()}};
    json["memory"] = {{"pages_per_stimulus_bytes", report.memory.pages_per_stimulus_bytes},
                      {"pages_at_once_bytes", report.memory.pages_at_once_bytes()},
                      {"streamed_pages_kept", report.memory.streamed_pages_kept},
                      {"maps_per_object_bytes", report.memory.maps_per_object_bytes}};
    if (report.recording)
        json["recording"] = to_json(*report.recording);
    json["surfaces"] = Json::array();
    for (const SurfaceFacts& surface : report.surfaces) {
        Json parts = Json::object();
        for (const auto& [name, share] : surface.part_shares)
            parts[name] = share;
        json["surfaces"].push_back(
            {{"object", surface.object},
             {"triangles", surface.triangles},
             {"size", {surface.size.object.x, surface.size.object.y, surface.size.object.z}},
             {"unit", surface.size.unit},
             {"shown_mm", {surface.size.shown_mm.x, surface.size.shown_mm.y}},
             {"shown_deg", {surface.size.shown_deg.x, surface.size.shown_deg.y}},
             {"part_shares", std::move(parts)}});
        if (surface.disparity)
            json["surfaces"].back()["disparity_arcmin"] = {{"nearest", surface.disparity->nearest_arcmin},
                                                           {"farthest", surface.disparity->farthest_arcmin}};
    }
    json["incidence"] = Json::array();
    for (const IncidenceCell& cell : report.incidence) {
        Json item{{"task", report.tasks.at(static_cast<std::size_t>(cell.task))}};
        add_stimulus(item, report, cell.stimulus);
        item["presentations"] = cell.presentations;
        json["incidence"].push_back(std::move(item));
    }
    json["is_seed_fixed"] = report.is_seed_fixed;
    json["orders"] = Json::array();
    for (std::size_t i = 0; i < report.schedules.size(); ++i)
        json["orders"].push_back(order_json(report, i));
    json["rotations"] = rotations_json(report);
    json["warnings"] = report.warnings;
    return json;
}

} // namespace overt
