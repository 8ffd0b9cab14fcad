#include <cmath>

#include <nlohmann/json.hpp>

#include "experiment/checks/design_report.h"
#include "experiment/protocol/protocol_keys.h"

namespace overt {

namespace {

using Json = nlohmann::ordered_json;

Json order_json(const DesignReport& report, std::size_t index) {
    const Schedule& schedule = report.schedules[index];
    Json trials = Json::array();
    for (const Trial& trial : schedule.trials) {
        Json item{{"trial", trial.index + 1}};
        if (!report.blocks.empty())
            item["block"] = report.blocks.at(static_cast<std::size_t>(trial.block));
        item["task"] = report.tasks.at(static_cast<std::size_t>(trial.task));
        item["object"] = report.objects.at(static_cast<std::size_t>(trial.stimulus.object));
        item["material"] = report.materials.at(static_cast<std::size_t>(trial.stimulus.material));
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

} // namespace

Json to_json(const DesignReport& report) {
    const AnimationFacts& animation = report.animation;
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
    json["blocks"] = blocks_json(report);
    json["trials"] = to_json(report.trials);
    json["groups"] = groups_json(report);
    json["animation"] = {{"frames", animation.frames},
                         {"distinct_poses", animation.distinct_poses},
                         {"shown_frames", animation.shown_frames},
                         {"refreshes_per_frame", animation.refreshes_per_frame},
                         {"refreshes", animation.refreshes},
                         {"duration_s", animation.duration_s},
                         {"periods", animation.periods},
                         {"amplitude_deg", report.motion.amplitude.value},
                         {"playback", name_of(report.motion.playback)}};
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
    }
    json["incidence"] = Json::array();
    for (const IncidenceCell& cell : report.incidence) {
        json["incidence"].push_back(
            {{"task", report.tasks.at(static_cast<std::size_t>(cell.task))},
             {"object", report.objects.at(static_cast<std::size_t>(cell.stimulus.object))},
             {"material", report.materials.at(static_cast<std::size_t>(cell.stimulus.material))},
             {"presentations", cell.presentations}});
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
