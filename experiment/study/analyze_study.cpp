#include "experiment/study/analyze_study.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/base/parallel.h"
#include "experiment/study/answer_gaze.h"
#include "experiment/study/answered_points.h"
#include "experiment/study/answers/answer_results.h"
#include "experiment/study/area_pairs.h"
#include "experiment/study/area_shares.h"
#include "experiment/study/difference_maps.h"
#include "experiment/study/error_budget.h"
#include "experiment/study/explorations.h"
#include "experiment/study/factor_effects.h"
#include "experiment/study/first_fixations.h"
#include "experiment/study/fixation_maps.h"
#include "experiment/study/gauge_reliefs.h"
#include "experiment/study/gaze_motion.h"
#include "experiment/study/light_at_gaze.h"
#include "experiment/study/map_predictions.h"
#include "experiment/study/map_reliability.h"
#include "experiment/study/measure_differences.h"
#include "experiment/study/methods/headline.h"
#include "experiment/study/methods/methods_text.h"
#include "experiment/study/methods/reporting.h"
#include "experiment/study/point_distributions.h"
#include "experiment/study/results/study_observers.h"
#include "experiment/study/scanpath_likeness.h"
#include "experiment/study/scanpaths.h"
#include "experiment/study/screen_area_looks.h"
#include "experiment/study/study_maps.h"
#include "experiment/study/study_pairs.h"
#include "experiment/study/surface_transitions.h"
#include "experiment/study/template/common_template.h"
#include "experiment/study/time_clusters.h"

namespace overt {

namespace {

void glance_at(StudyResults& results, const ExclusionRules& rules) {
    StudyGlance& glance = results.glance;
    std::vector<std::string> protocols;
    for (const StudySession& session : results.sessions) {
        if (std::find(protocols.begin(), protocols.end(), session.protocol) == protocols.end())
            protocols.push_back(session.protocol);
        glance.any_simulated |= session.is_simulated();
    }
    glance.title = fmt::format("{}", fmt::join(protocols, "; "));
    results.observers = study_observers(results);
    glance.observers = static_cast<int>(std::ranges::count_if(results.observers, &StudyObserver::counts));
    glance.sessions = static_cast<int>(results.sessions.size());
    glance.trials = static_cast<int>(results.trials.size());
    std::map<ExclusionRule, int> excluded_by;
    for (const StudyTrial& trial : results.trials) {
        glance.excluded_trials += trial.excluded;
        const std::optional<ExclusionRule> rule = broken_rule(trial.quality, rules);
        if (!trial.has_gaze)
            ++glance.without_gaze;
        else if (rule)
            ++excluded_by[*rule];
    }
    glance.excluded_by.assign(excluded_by.begin(), excluded_by.end());
    std::map<NotCounted, int> reasons;
    for (const StudyFixation& fixation : results.fixations) {
        ++glance.fixations;
        if (fixation.counted()) {
            ++glance.counted;
            glance.counted_s += fixation.duration_s;
            glance.only_by_reach += fixation.only_by_reach;
        } else {
            ++reasons[fixation.why];
        }
    }
    glance.not_counted.assign(reasons.begin(), reasons.end());

    std::vector<std::string>& remarks = results.remarks;
    if (protocols.size() > 1)
        remarks.push_back(fmt::format(
            "The sessions are of {} protocols: {}. Groups with the same words are pooled; an object "
            "with another mesh or camera is one of its own.",
            protocols.size(), fmt::join(protocols, "; ")));
    for (std::string& remark : remarks_on_observers(results.observers))
        remarks.push_back(std::move(remark));
    if (glance.observers < 3)
        remarks.push_back(fmt::format("There {} only {}: intervals over observers need three.",
                                      glance.observers == 1 ? "is" : "are",
                                      counted(glance.observers, "observer")));
    for (const StudySession& session : results.sessions) {
        if (!session.is_complete)
            remarks.push_back(fmt::format("{} is not complete: {} of it count.", session.folder,
                                          counted(session.trials, "trial")));
    }
    if (glance.counted == 0 && knows_stimuli(results))
        remarks.emplace_back("No fixation was counted: there are no maps and no fractions.");
    if (glance.only_by_reach > 0)
        remarks.push_back(fmt::format(
            "{} of {} counted fixations ({:.1f} %) count only because samples that miss the object by no "
            "more than the reach are placed at its outline.",
            glance.only_by_reach, glance.counted, 100.0 * glance.only_by_reach / glance.counted));
    if (const std::optional<double> rate = rate_too_low_for_counts(results); rate && glance.counted > 0)
        remarks.push_back(fmt::format(
            "Gaze was sampled at {:.3g} Hz, too seldom to tell short saccades: fixations near each other run "
            "together, so that counts of fixations and shares by count are unsafe, most of all of small "
            "areas such "
            "as a head. Take shares by duration.",
            *rate));
    const auto foreign = std::ranges::count_if(
        results.sessions, [](const StudySession& session) { return session.setup.presenter.has_value(); });
    // An EyeLink's recording tells the validations of its tracker, tables do not.
    const bool is_accuracy_known = std::ranges::any_of(
        results.trials, [](const StudyTrial& trial) { return trial.quality.accuracy_deg.has_value(); });
    if (foreign > 0)
        remarks.push_back(
            fmt::format("{} presented by another program, and gaze was imported: which refreshes "
                        "were missed is not known{}; places on moving objects are as good as the "
                        "log of onsets and the latency that the protocol gives.",
                        foreign == std::ssize(results.sessions) ? "All sessions were"
                        : foreign == 1                          ? "One session was"
                                                                : fmt::format("{} sessions were", foreign),
                        is_accuracy_known ? "" : ", nor how exactly gaze was measured"));
    if (glance.any_simulated)
        remarks.push_back(
            fmt::format("The gaze of {} sessions is that of simulated observers.",
                        std::ranges::all_of(results.sessions, &StudySession::is_simulated) ? "all" : "some"));
}

struct ObjectMaps {
    std::vector<float> exposure;
    std::vector<StudyMap> maps;
};

/// Of one object, beside others. Writes to `surface` alone.
ObjectMaps maps_of_object(const StudyResults& results, int object, ObjectSurface& surface,
                          const StudyOptions& options) {
    const StudyObject& shown = results.objects[static_cast<std::size_t>(object)];
    const auto [least, widest] = sigma_range_mm(results, object);
    ObjectMaps made;
    std::optional<DensityMaker> maker;
    if (surface.geometry && surface.scale && widest > 0.0) {
        if (HatSmoother::is_worth_while(*surface.geometry, least))
            surface.hats = std::make_unique<HatSmoother>(*surface.geometry, least, widest);
        maker.emplace(surface, *shown.mesh, options, widest);
        made.exposure = exposure_density(results, object, surface, *maker, options);
    }
    made.maps = maps_on(results, object, surface, maker ? &*maker : nullptr);
    return made;
}

/// Objects beside each other; the results come in their order.
void add_maps(ReadStudy& study, const StudyOptions& options, const StudyProgress& progress) {
    StudyResults& results = study.results;
    const int objects = static_cast<int>(results.objects.size());
    std::vector<ObjectMaps> made(results.objects.size());
    int done = 0;
    std::mutex progress_mutex;
    progress("maps", 0, objects);
    parallel_for(objects, [&](int object) {
        const auto index = static_cast<std::size_t>(object);
        made[index] = maps_of_object(results, object, study.surfaces[index], options);
        const std::scoped_lock lock(progress_mutex);
        progress("maps", ++done, objects);
    });
    for (std::size_t i = 0; i < made.size(); ++i) {
        results.objects[i].exposure_density = std::move(made[i].exposure);
        std::ranges::move(made[i].maps, std::back_inserter(results.maps));
    }
    for (int object = 0; object < objects; ++object)
        add_error_budget(results, object, study.surfaces[static_cast<std::size_t>(object)]);
    std::stable_sort(results.maps.begin(), results.maps.end(), [](const StudyMap& a, const StudyMap& b) {
        return std::tie(a.group, a.object, a.weighting) < std::tie(b.group, b.object, b.weighting);
    });
}

/// The share of the fixations on each area, beside its share of the exposure.
void add_fixations_to_exposures(StudyResults& results) {
    for (ExposureRow& row : results.exposures) {
        const StudyObject& shown = results.objects[static_cast<std::size_t>(row.object)];
        const std::optional<std::size_t> area = shown.areas.find(row.area);
        int all = 0, own = 0;
        for_each_counted_on(results, row.object, [&](const StudyFixation& fixation) {
            all += fixation.part.has_value();
            own += fixation.part && (!area || shown.areas.holds(*area, fixation.part));
        });
        if (all > 0)
            row.share_of_fixations = static_cast<double>(own) / all;
    }
}

/// What a reader must know of the maps of differences.
void remark_on_differences(StudyResults& results, const StudyOptions& options) {
    if (results.glance.counted == 0)
        return; // nothing is compared, and that was said
    int most = 0;
    double least_p = 1.0;
    for (const DifferenceMap& map : results.differences) {
        most = std::max(most, map.observers);
        least_p = std::min(least_p, map.least_p);
    }
    if (most < 2)
        results.remarks.push_back(
            fmt::format("No two observers saw one object in two levels of {}: there are no maps of "
                        "differences.",
                        options.compare));
    else if (least_p > 1.0 - options.confidence + 1e-9)
        results.remarks.push_back(fmt::format(
            "Maps of differences are of {} at most, for whom no cluster can have a smaller p than {:.3g}: "
            "that takes {} observers for p below 0.05.",
            counted(most, "observer"), least_p, 6));
}

/// How gaze goes over the surfaces, and what else trials come to, between levels.
void reckon_ways(ReadStudy& study, const ObjectFixationMaps& maps, const StudyOptions& options) {
    StudyResults& results = study.results;
    const ObjectDistances distances = surface_distances(results, study.surfaces);
    const std::vector<TrialScanpath> scanpaths = trial_scanpaths(results, distances, maps);
    results.scanpaths = scanpath_rows(results, scanpaths, study.levels, options);
    results.scanpath_likeness = scanpath_likeness(results, distances, study.levels, options);
    std::vector<MeasureOfTrials> measures = looking_measures(results);
    std::ranges::move(scanpath_measures(scanpaths), std::back_inserter(measures));
    results.measure_differences = measure_differences(results, measures, study.levels, options);
}

/// All that needs places on surfaces.
void reckon_on_surfaces(ReadStudy& study, const StudyOptions& options, const StudyProgress& progress) {
    StudyResults& results = study.results;
    add_maps(study, options, progress);
    results.area_rows = area_rows(results, study.levels, options);
    results.surface_transitions = surface_transitions(results, study.levels, options);
    results.distributions = point_distributions(results, study.surfaces, options);
    results.time_course = area_time_course(results, study.levels, options);
    results.time_clusters = time_clusters(results, study.levels, options);
    results.first_fixations = first_fixations(results, study.levels, options);
    progress("comparisons", 0, 1);
    const ObjectFixationMaps maps = fixation_maps(results, study.surfaces);
    results.pairs = study_pairs(results, study.surfaces, maps, study.levels, options);
    results.area_pairs = area_pairs(results, study.surfaces, study.levels, options);
    reckon_ways(study, maps, options);
    progress("comparisons", 1, 1);
    progress("differences", 0, 1);
    results.differences = difference_maps(results, maps, study.levels, options);
    remark_on_differences(results, options);
    results.answers.gaze = answer_gaze(results);
    results.answers.gaze_choices = gaze_choices(results, options);
    results.answer_maps = answer_maps(results, maps, options);
    progress("differences", 1, 1);
    progress("metrics", 0, 1);
    results.predictions =
        map_predictions(results, maps, options, model_maps(results, study.surfaces, options));
    results.reliabilities = map_reliabilities(results, maps, study.levels, options);
    add_fixations_to_exposures(results);
    results.effects = factor_effects(results, study.levels, options);
    results.motions = gaze_motions(results, study.levels, options);
    results.lights = lights_at_gaze(results, study.levels, options);
    progress("metrics", 1, 1);
}

} // namespace

StudyResults analyze_study(std::span<const std::filesystem::path> sessions, const SurfaceFor& surface_for,
                           const StudyOptions& options, const StudyProgress& progress) {
    return analyze_study(read_study(sessions, surface_for, options, progress), options, progress);
}

StudyResults analyze_study(ReadStudy study, const StudyOptions& options, const StudyProgress& progress) {
    StudyResults& results = study.results;
    if (options.is_by_asked)
        check_asked_factors(options.by, study.levels);
    bring_to_template(study, options);
    results.parameters = parameters_of(options);
    results.by = options.by;
    results.confidence = options.confidence;
    name_areas(results, options);
    glance_at(results, options.exclude);
    results.groups = make_groups(results, options.by, study.levels);

    add_screen_area_looks(results, study.levels, options);
    reckon_answers(results.answers, options);
    reckon_reliefs(results.reliefs, options.bootstrap());
    reckon_explorations(results.explorations, options.bootstrap());
    if (knows_stimuli(results))
        reckon_on_surfaces(study, options, progress);
    reckon_points(results, options);
    results.headline = study_headline(results, options);
    results.reporting = reporting_items(results, options);
    results.methods = methods_text(results, options);
    return std::move(study.results);
}

} // namespace overt
