#include "app/bench/statistics_studies.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/scene/sculptures/sculptures.h"
#include "experiment/study/area_pairs.h"
#include "experiment/study/area_shares.h"
#include "experiment/study/difference_maps.h"
#include "experiment/study/factor_effects.h"
#include "experiment/study/map_predictions.h"
#include "experiment/study/map_reliability.h"
#include "experiment/study/measure_differences.h"
#include "experiment/study/point_distributions.h"
#include "experiment/study/read/area_evidence.h"
#include "experiment/study/study_pairs.h"
#include "experiment/study/time_clusters.h"

namespace overt {

namespace {

constexpr const char *material_column = "material", *task_column = "task";

/// Sculptures coarse enough for thousands of studies.
Experiment two_sculptures() {
    Experiment experiment;
    Protocol& protocol = experiment.protocol;
    protocol.name = "bench statistics";
    constexpr int size_px = 512;
    protocol.views.front().width_px = protocol.views.front().height_px = size_px;
    for (const SculptureDescription& shipped : shipped_sculptures().first(2)) {
        ObjectSettings settings;
        settings.id = settings.shipped = std::string(shipped.name);
        protocol.objects.push_back(std::move(settings));
        Object object;
        object.id = std::string(shipped.name);
        object.mesh = make_sculpture(shipped.name, coarse_cell_share);
        const View view{fit_camera(*object.mesh, {11.9}, {size_px, size_px}, {25.0}, 0.06),
                        {size_px, size_px}};
        object.scenes = {{view, object.mesh->bounds()}};
        experiment.objects.push_back(std::move(object));
    }
    for (const char* id : {"smooth", "rough"}) {
        MaterialSettings material;
        material.id = id;
        protocol.materials.push_back(std::move(material));
    }
    for (const char* id : {"first", "second"}) {
        Task task;
        task.id = id;
        task.simulated_head_share = 0.35;
        protocol.tasks.push_back(std::move(task));
    }
    protocol.schedule.max_object_run = 0;
    return experiment;
}

void add_p(StudyStatistics& to, const std::string& name, const std::optional<double>& p) {
    if (p)
        to.p[name] = *p;
}

void add_similarity(StudyStatistics& to, const std::string& name, const SimilarityEstimate& similarity) {
    add_p(to, "table1_pairs " + name + "_p", similarity.p);
    to.estimates["table1_pairs " + name] = similarity.value;
    to.estimates["table1_pairs " + name + "_same_level"] = similarity.same_level;
    to.estimates["table1_pairs " + name + "_other_level"] = similarity.other_level;
    to.estimates["table1_pairs " + name + "_level_effect"] = similarity.level_effect;
}

/// Of levels that are alike it is 0.
bool is_difference(const std::string& name) {
    return name.find("difference") != std::string::npos || name.find("level_effect") != std::string::npos ||
           name.find("effect_size") != std::string::npos;
}

} // namespace

StatisticsStudies::StatisticsStudies(const StatisticsSetting& setting)
    : setting_(setting), experiment_(two_sculptures()) {
    GazeStudySettings gaze;
    gaze.head_share_sd = 0.4;
    const std::string effect =
        setting.is_planted ? "head:material=rough:odds=1.8" : "head:material=rough:odds=1";
    const auto studies_with = [&](double accuracy_deg) {
        gaze.accuracy_deg = accuracy_deg;
        return std::make_unique<GazeStudies>(
            experiment_, power_effects({effect}, experiment_.protocol, areas_of(experiment_.objects)), gaze);
    };
    studies_ = studies_with(setting.accuracy_deg);
    without_error_ = studies_with(0.0);
    turn_ = std::make_unique<PursuedTurn>(studies_->scene());
    poses_ = distinct_poses(studies_->scene().animation_of(0));
    for (std::size_t i = 0; i < experiment_.objects.size(); ++i) {
        const Mesh& mesh = *experiment_.objects[i].mesh;
        ObjectSurface& surface = surfaces_.emplace_back();
        surface.scale = studies_->surfaces()[i].scale;
        surface.geometry = std::make_unique<SurfaceGeometry>(mesh, surface.scale->mm_per_unit);
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
    }
}

StatisticsStudies::~StatisticsStudies() = default;

void StatisticsStudies::add_evidence(StudyResults& results) const {
    const ObservedScene& scene = studies_->scene();
    for (std::size_t object = 0; object < results.objects.size(); ++object) {
        std::vector<MeasuredPlace> places;
        std::vector<StudyFixation*> fixations;
        for (StudyFixation& fixation : results.fixations) {
            const StudyTrial& trial = results.trials[static_cast<std::size_t>(fixation.trial)];
            if (static_cast<std::size_t>(trial.object) != object ||
                (!fixation.counted() && fixation.why != NotCounted::not_on_surface))
                continue;
            const SessionDuration middle = from_seconds(fixation.onset_s + 0.5 * fixation.duration_s);
            fixations.push_back(&fixation);
            places.push_back({poses_.pose_of(0, scene.animation_of(0).frame_at_step(turn_->step_at(middle))),
                              scene.screen.image_from_screen(fixation.place),
                              setting_.accuracy_deg * px_per_deg_at_centre(scene.screen), fixation.trial});
        }
        auto evidence = area_evidence(*results.objects[object].mesh, results.objects[object].areas,
                                      scene.objects[object].scene, poses_.angles, places);
        for (std::size_t i = 0; i < fixations.size(); ++i)
            fixations[i]->evidence = std::move(evidence[i]);
    }
}

StudyStatistics StatisticsStudies::study(std::uint64_t seed) const {
    StudyResults results = studies_->study(seed, setting_.observers);
    for (std::size_t i = 0; i < results.objects.size(); ++i) {
        StudyObject& object = results.objects[i];
        object.mesh = std::make_shared<const Mesh>(*experiment_.objects[i].mesh);
        object.seconds_visible.assign(object.mesh->positions.size(), 8.0f);
        object.exposure_density.assign(object.mesh->positions.size(), 1.0f);
    }
    for (StudyFixation& fixation : results.fixations) {
        fixation.barycentric = glm::max(fixation.barycentric, glm::dvec3(0.0));
        const double sum = fixation.barycentric.x + fixation.barycentric.y + fixation.barycentric.z;
        if (sum > 0.0)
            fixation.barycentric /= sum;
    }
    results.areas = results.compared_areas = {"head"};
    results.area = "head";
    add_evidence(results);
    StudyOptions options;
    options.seed = seed;
    options.resamples = 500;
    options.permutations = 200;
    options.compare = material_column;
    options.by = results.by = {task_column, material_column};
    StudyStatistics found;
    for (const FactorEffectRow& row : factor_effects(results, studies_->levels(), options))
        add_p(found, "factor_effects " + row.measure + ", " + row.effect, row.p);

    // Two trials of each level, which can be dealt out again.
    options.by = results.by = {material_column};
    results.groups = make_groups(results, options.by, studies_->levels());
    const AreaPairRow of_head = area_pairs(results, surfaces_, studies_->levels(), options).front();
    add_p(found, "area_pairs p", of_head.p);
    found.estimates["area_pairs difference"] = of_head.difference;
    found.estimates["area_pairs effect_size"] = of_head.evidence.effect_size;
    for (const AreaRow& row : area_rows(results, studies_->levels(), options)) {
        if (row.keys.empty()) {
            found.estimates["areas by_count"] = row.by_count;
            found.estimates["areas by_duration"] = row.by_duration;
            found.estimates["areas corrected"] = row.corrected;
            found.estimates["areas dwell_s"] = row.dwell_s;
            found.estimates["areas first_arrival_s"] = row.first_arrival_s;
        }
    }
    StudyResults exact = without_error_->study(seed, setting_.observers);
    exact.areas = results.areas;
    exact.by = options.by;
    exact.groups = make_groups(exact, options.by, studies_->levels());
    for (const AreaRow& row : area_rows(exact, studies_->levels(), options)) {
        if (row.keys.empty() && row.by_count.value)
            found.planted["areas corrected"] = *row.by_count.value;
    }
    for (const MeasureDifferenceRow& row :
         measure_differences(results, looking_measures(results), studies_->levels(), options)) {
        const std::string name = "measure_differences " + row.measure + (row.of.empty() ? "" : ", ") + row.of;
        add_p(found, name + " p", row.p);
        found.estimates[name + " difference"] = row.difference;
    }
    double least_in_time = 1.0;
    for (const TimeClusterRow& row : time_clusters(results, studies_->levels(), options))
        least_in_time = std::min(least_in_time, row.p);
    found.p["time_clusters p, the least"] = least_in_time;
    found.estimates["figure5_distribution wss_deg2"] =
        point_distributions(results, surfaces_, options).front().wss_deg2;
    const ObjectFixationMaps maps = fixation_maps(results, surfaces_);
    const PairRow pair = study_pairs(results, surfaces_, maps, studies_->levels(), options).front();
    add_p(found, "table1_pairs wss_p", pair.wss_p);
    add_p(found, "table1_pairs maps_p", pair.maps_p);
    found.estimates["table1_pairs wss_difference_deg2"] = pair.wss_difference_deg2;
    add_similarity(found, "cc", pair.cc);
    add_similarity(found, "sim_mit", pair.sim_mit);
    const MapPredictionRow prediction = map_predictions(results, maps, options).front();
    found.estimates["map_predictions gain_over_exposure"] = prediction.gain_over_exposure;
    found.estimates["map_predictions nss"] = prediction.nss;
    found.estimates["map_predictions kl"] = prediction.kl;
    found.estimates["map_predictions auc_judd"] = prediction.auc_judd;
    const MapReliabilityRow reliability =
        map_reliabilities(results, maps, studies_->levels(), options).front();
    found.estimates["map_reliability reliability"] = reliability.reliability;
    found.estimates["map_reliability split_half_cc"] = reliability.split_half_cc;
    double least = 1.0;
    for (const DifferenceMap& map : difference_maps(results, maps, studies_->levels(), options)) {
        for (const DifferenceMap::Cluster& cluster : map.clusters)
            least = std::min(least, cluster.p_of_all);
    }
    found.p["difference_clusters p_of_all, the least"] = least;
    return found;
}

std::vector<StatisticsCount> count_statistics(const StatisticsSetting& setting, int studies,
                                              std::uint64_t seed, const std::function<void(int)>& done) {
    const StatisticsStudies of(setting);
    std::vector<StudyStatistics> all(static_cast<std::size_t>(studies));
    std::mutex done_mutex;
    int count_done = 0;
    parallel_for(studies, [&](int i) {
        RandomStream random(seed, "seeds of studies", static_cast<std::uint64_t>(i));
        all[static_cast<std::size_t>(i)] = of.study(random.next_bits());
        const std::scoped_lock lock(done_mutex);
        ++count_done;
        if (done)
            done(count_done);
    });
    std::map<std::string, StatisticsCount> p, intervals;
    std::map<std::string, int> values;
    for (const StudyStatistics& one : all) {
        for (const auto& [name, value] : one.p) {
            StatisticsCount& count = p[name];
            count.is_p = true;
            ++count.studies;
            count.hits += value <= 0.05 + 1e-12;
        }
        for (const auto& [name, estimate] : one.estimates) {
            if (estimate.value) {
                intervals[name].mean += *estimate.value;
                ++values[name];
            }
        }
    }
    for (auto& [name, count] : intervals) {
        count.mean /= values[name];
        count.truth = !setting.is_planted && is_difference(name) ? 0.0 : count.mean;
        if (all.front().planted.contains(name)) {
            count.truth = 0.0;
            for (const StudyStatistics& one : all)
                count.truth += one.planted.at(name) / studies;
        }
    }
    for (const StudyStatistics& one : all) {
        for (const auto& [name, estimate] : one.estimates) {
            if (!estimate.interval)
                continue;
            StatisticsCount& count = intervals[name];
            ++count.studies;
            count.hits += estimate.interval->contains(count.truth);
        }
    }
    std::vector<StatisticsCount> counts;
    for (auto* list : {&p, &intervals}) {
        for (auto& [name, count] : *list) {
            count.what = name;
            if (count.studies > 0)
                counts.push_back(count);
        }
    }
    return counts;
}

} // namespace overt
