#include "experiment/report/report_tables.h"

#include "experiment/report/report_areas.h"

namespace overt {

Json report_tables(const StudyResults& results) {
    Json areas = Json::array(), transitions = Json::array(), area_pairs = Json::array(),
         distributions = Json::array(), pairs = Json::array(), effects = Json::array(),
         motions = Json::array(), lights = Json::array(), predictions = Json::array(),
         reliabilities = Json::array(), exposures = Json::array(), course = Json::array();
    for (const AreaRow& row : results.area_rows) {
        Json json{{"area", row.area},
                  {"keys", json_of(row.keys)},
                  {"count", json_of(row.by_count)},
                  {"duration", json_of(row.by_duration)},
                  {"corrected", json_of(row.corrected)},
                  {"pooled", number(row.pooled)},
                  {"each", Json::array()},
                  {"observers", row.observers},
                  {"trials", row.trials},
                  {"fixations", row.fixations},
                  {"surface", number(row.share_of_surface, 4)},
                  {"exposure", number(row.share_of_exposure, 4)},
                  {"over_exposure", json_of(row.over_exposure)},
                  {"dwell", json_of(row.dwell_s)},
                  {"visits", json_of(row.visits)},
                  {"visit", json_of(row.visit_s)},
                  {"reached", json_of(row.reached)},
                  {"arrival", json_of(row.first_arrival_s)},
                  {"arrival_number", json_of(row.first_arrival_number)}};
        for (const double share : row.of_observers)
            json["each"].push_back(number(share, 4));
        if (row.pooled_interval)
            json["pooled_ci"] = {number(row.pooled_interval->low), number(row.pooled_interval->high)};
        areas.push_back(std::move(json));
    }
    for (const SurfaceTransitionRow& row : results.surface_transitions)
        transitions.push_back({{"keys", json_of(row.keys)},
                               {"from", row.from},
                               {"to", row.to},
                               {"p", json_of(row.probability)},
                               {"chance", json_of(row.chance)},
                               {"over", json_of(row.over_chance)},
                               {"count", row.transitions},
                               {"observers", row.observers}});
    for (const AreaPairRow& row : results.area_pairs)
        area_pairs.push_back({{"area", row.area},
                              {"keys", json_of(row.keys)},
                              {"column", row.column},
                              {"a", row.a},
                              {"b", row.b},
                              {"difference", json_of(row.difference)},
                              {"p", number(row.p)},
                              {"holm", number(row.p_holm)},
                              {"holm_areas", number(row.p_holm_areas)},
                              {"evidence", json_of(row.evidence)},
                              {"observers", row.observers},
                              {"comparisons", row.comparisons}});
    for (const DistributionRow& row : results.distributions) {
        Json variance = Json::array(), variance_deg = Json::array();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            variance.push_back(number(row.variance_mm2[axis]));
            variance_deg.push_back(number(row.variance_deg2[axis]));
        }
        distributions.push_back({{"group", row.group},
                                 {"object", row.object},
                                 {"wss", json_of(row.wss_mm2)},
                                 {"wss_deg", json_of(row.wss_deg2)},
                                 {"variance", variance},
                                 {"variance_deg", variance_deg},
                                 {"peak", number(row.map_peak)},
                                 {"mean", number(row.map_mean)},
                                 {"observers", row.observers},
                                 {"fixations", row.fixations}});
    }
    for (const PairRow& row : results.pairs)
        pairs.push_back({{"keys", json_of(row.keys)},
                         {"column", row.column},
                         {"a", row.a},
                         {"b", row.b},
                         {"wss", json_of(row.wss_difference_mm2)},
                         {"wss_deg", json_of(row.wss_difference_deg2)},
                         {"p", number(row.wss_p)},
                         {"holm", number(row.wss_p_holm)},
                         {"evidence", json_of(row.wss_evidence)},
                         {"maps_cc", number(row.maps_cc)},
                         {"maps_p", number(row.maps_p)},
                         {"maps_holm", number(row.maps_p_holm)},
                         {"cc", json_of(row.cc)},
                         {"sim", json_of(row.sim_mit)},
                         {"sim_plain", json_of(row.sim_pysaliency)},
                         {"observers", row.observers},
                         {"comparisons", row.comparisons},
                         {"absent", row.absent}});
    for (const FactorEffectRow& row : results.effects)
        effects.push_back({{"measure", row.measure},
                           {"effect", row.effect},
                           {"p", number(row.p)},
                           {"holm", number(row.p_holm)},
                           {"least", number(row.least_p)},
                           {"observers", row.observers},
                           {"absent", row.absent}});
    for (const GazeMotionRow& row : results.motions)
        motions.push_back({{"keys", json_of(row.keys)},
                           {"gain", json_of(row.surface_gain)},
                           {"corrected", json_of(row.corrected_gain)},
                           {"speed", json_of(row.surface_speed_deg_s)},
                           {"observers", row.observers},
                           {"fixations", row.fixations}});
    for (const LightAtGazeRow& row : results.lights)
        lights.push_back({{"keys", json_of(row.keys)},
                          {"met", json_of(row.lightness)},
                          {"place", json_of(row.over_place)},
                          {"point", json_of(row.over_point)},
                          {"observers", row.observers},
                          {"fixations", row.fixations}});
    for (const MapPredictionRow& row : results.predictions)
        predictions.push_back({{"group", row.group},
                               {"object", row.object},
                               {"by", name_of(row.by)},
                               {"level", row.level},
                               {"kl", json_of(row.kl)},
                               {"nss", json_of(row.nss)},
                               {"auc", json_of(row.auc_judd)},
                               {"borji", json_of(row.auc_borji)},
                               {"gain", json_of(row.gain_over_exposure)},
                               {"gain_area", json_of(row.gain_over_area)},
                               {"ceiling", json_of(row.share_of_ceiling)},
                               {"observers", row.observers}});
    for (const MapReliabilityRow& row : results.reliabilities)
        reliabilities.push_back({{"keys", json_of(row.keys)},
                                 {"object", row.object},
                                 {"split", json_of(row.split_half_cc)},
                                 {"reliability", json_of(row.reliability)},
                                 {"observers", row.observers},
                                 {"fixations", row.fixations}});
    for (const ExposureRow& row : results.exposures)
        exposures.push_back({{"object", row.object},
                             {"area_name", row.area.empty() ? std::string("all") : row.area},
                             {"area", number(row.area_mm2)},
                             {"share_of_area", number(row.share_of_area, 4)},
                             {"never", number(row.never_visible, 4)},
                             {"seconds", number(row.seconds_visible, 4)},
                             {"share", number(row.share_of_exposure, 4)},
                             {"foreshortening", number(row.foreshortening, 4)},
                             {"fixations", number(row.share_of_fixations, 4)}});
    for (const TimeCourseRow& row : results.time_course)
        course.push_back({{"area", row.area},
                          {"key", {row.key.column, row.key.value}},
                          {"from", row.from_s},
                          {"to", row.to_s},
                          {"share", json_of(row.share)},
                          {"observers", row.observers}});
    Json measures = Json::array();
    for (const MeasureDifferenceRow& row : results.measure_differences)
        measures.push_back({{"measure", row.measure},
                            {"of", row.of},
                            {"unit", row.unit},
                            {"a", row.a},
                            {"b", row.b},
                            {"difference", json_of(row.difference)},
                            {"p", number(row.p)},
                            {"holm", number(row.p_holm)},
                            {"evidence", json_of(row.evidence)},
                            {"observers", row.observers}});
    Json clusters = Json::array();
    for (const TimeClusterRow& row : results.time_clusters) {
        if (row.number > 0)
            clusters.push_back({{"area", row.area},
                                {"a", row.a},
                                {"b", row.b},
                                {"from", number(row.from_s)},
                                {"to", number(row.to_s)},
                                {"difference", number(row.difference)},
                                {"p", number(row.p)},
                                {"p_all", number(row.p_of_all)},
                                {"least", number(row.least_p)},
                                {"observers", row.observers}});
    }
    Json first = Json::array();
    for (const FirstFixationsRow& row : results.first_fixations)
        first.push_back({{"area", row.area},
                         {"keys", json_of(row.keys)},
                         {"number", row.number},
                         {"at", json_of(row.at)},
                         {"up_to", json_of(row.up_to)},
                         {"observers", row.observers},
                         {"trials", row.trials}});
    Json ways = Json::array();
    for (const ScanpathRow& row : results.scanpaths)
        ways.push_back({{"keys", json_of(row.keys)},
                        {"fixations", json_of(row.fixations)},
                        {"fixation", json_of(row.fixation_s)},
                        {"step_mm", json_of(row.step_mm)},
                        {"step_deg", json_of(row.step_deg)},
                        {"way", json_of(row.way_mm)},
                        {"coverage", json_of(row.coverage)},
                        {"effective", json_of(row.entropy)},
                        {"recurrence", json_of(row.recurrence)},
                        {"determinism", json_of(row.determinism)},
                        {"distance", json_of(row.return_distance)},
                        {"observers", row.observers},
                        {"trials", row.trials}});
    Json likeness = Json::array();
    for (const ScanpathLikenessRow& row : results.scanpath_likeness)
        likeness.push_back({{"measure", row.measure},
                            {"keys", json_of(row.keys)},
                            {"a", row.a},
                            {"b", row.b},
                            {"same", json_of(row.same_level)},
                            {"other", json_of(row.other_level)},
                            {"effect", json_of(row.level_effect)},
                            {"shuffled", json_of(row.shuffled)},
                            {"observers", row.observers}});
    Json tables{{"measure_differences", measures},
                {"time_clusters", clusters},
                {"first_fixations", first},
                {"ways", ways},
                {"likeness", likeness},
                {"surface_areas", areas},
                {"surface_transitions", transitions},
                {"area_pairs", area_pairs},
                {"distributions", distributions},
                {"pairs", pairs},
                {"effects", effects},
                {"motions", motions},
                {"lights", lights},
                {"predictions", predictions},
                {"reliabilities", reliabilities},
                {"exposures", exposures},
                {"course", course}};
    add_area_tables(tables, results);
    return tables;
}

} // namespace overt
