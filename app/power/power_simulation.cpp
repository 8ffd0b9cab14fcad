#include "app/power/power_simulation.h"

#include <algorithm>
#include <memory>
#include <mutex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/power/answer_studies.h"
#include "app/power/effect_tests.h"
#include "app/power/planted_spread.h"
#include "app/power/power_tests.h"
#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/schedule.h"
#include "experiment/scene/areas.h"

namespace overt {

namespace {

std::string analysis_of_answers(const Protocol& protocol, const PowerEffect& effect, bool is_equivalence) {
    return fmt::format(
        "overt analyze SESSION…: the row of {}, \"{}\" of {} {} against {} in answer_differences, {}",
        AnswerStudies(protocol, effect).measured().name(), effect.answer, effect.column, effect.level,
        effect.against, is_equivalence ? "equivalence_p" : "p");
}

std::string analysis_of(const Protocol& protocol, const PowerEffect& effect, bool is_equivalence) {
    if (is_of_answers(effect.measure))
        return analysis_of_answers(protocol, effect, is_equivalence);
    if (effect.test == PowerTest::cluster)
        return fmt::format("overt analyze SESSION… --by object,{0} --compare {0}: clusters of {1} and {2} in "
                           "difference_clusters, p_of_all",
                           effect.column, effect.level, effect.against);
    if (effect.test != PowerTest::pair)
        return fmt::format(
            "overt analyze SESSION… --by object,{}: the row of {}, {} in factor_effects, p",
            fmt::join(columns_of_test(effect), ","),
            effect.measure == PowerMeasure::area ? "share on " + effect.area : std::string("log WSS"),
            effect.test == PowerTest::factor
                ? effect.column
                : fmt::format("{} and {} together", effect.column, effect.interacting_column()));
    const bool is_of_stimuli = effect.column != "task";
    const std::string place = effect.measure == PowerMeasure::area
                                  ? fmt::format("area_pairs, area {}", effect.area)
                                  : std::string("table1_pairs");
    const bool is_area = effect.measure == PowerMeasure::area, is_wss = effect.measure == PowerMeasure::wss;
    const char* const column = is_area  ? is_equivalence ? "equivalence_p" : "p"
                               : is_wss ? is_equivalence ? "wss_equivalence_p" : "wss_p"
                                        : "maps_p";
    std::string row = is_of_stimuli ? "the row over all tasks" : "the row";
    for (const StudyKey& key : effect.within)
        row = fmt::format("the row of {} {}", key.column, key.value);
    return fmt::format("overt analyze SESSION… --by {} --compare {}: {} of {} against {} in {}, {}",
                       is_of_stimuli ? "task,object," + effect.column : std::string("task,object"),
                       effect.column, row, effect.level, effect.against, place, column);
}

std::string planted_in_answers(const PowerEffect& effect) {
    const std::string where = fmt::format("In {} {}", effect.column, effect.level);
    switch (effect.measure) {
    case PowerMeasure::threshold:
        return effect.is_ratio
                   ? fmt::format(
                         "{} the slope is divided by {}, so that the threshold is as many times as far "
                         "from the standard.",
                         where, effect.size)
                   : fmt::format("{} the threshold is higher by {}.", where, effect.size);
    case PowerMeasure::slope:
        return fmt::format("{} the slope is multiplied by {}.", where, effect.size);
    case PowerMeasure::choice:
        return fmt::format("{} the judgement is higher by {} standard deviations.", where, effect.size);
    case PowerMeasure::rating:
        return fmt::format("{} the judgement is higher by {}.", where, effect.size);
    default:
        return fmt::format("{} the odds of a correct answer are multiplied by {}.", where, effect.size);
    }
}

std::string planted_words(const PowerEffect& effect) {
    std::string words;
    if (effect.is_none())
        words = "No difference is planted, on average.";
    else if (is_of_answers(effect.measure))
        words = planted_in_answers(effect);
    else if (effect.measure == PowerMeasure::area)
        words = fmt::format("In {} {} the odds of the {} are multiplied by {}.", effect.column, effect.level,
                            effect.area == head_area ? effect.area : fmt::format("area {}", effect.area),
                            effect.size);
    else if (effect.measure == PowerMeasure::cc)
        words = fmt::format("In {} {} a share of {} of the fixations goes to one spot of each object.",
                            effect.column, effect.level, effect.size);
    return words;
}

std::vector<StudyParameter> parameters_of(const Protocol& protocol, const PowerSettings& settings) {
    const auto text = [](auto number) { return fmt::format("{}", number); };
    std::vector<std::string> shares;
    for (const Task& task : protocol.tasks) {
        std::string of_task = task.id;
        for (const auto& [area, share] : simulated_shares(task))
            of_task += share > 0.0 ? fmt::format(" {} {}", area, share) : std::string();
        shares.push_back(std::move(of_task));
    }
    return {
        {"observers", fmt::format("{}", fmt::join(settings.observers, ",")), "", "Of a study."},
        {"studies", text(settings.studies), "", "That were simulated."},
        {"alpha", text(settings.alpha), "", "A study has found the effect if p is at most this."},
        {"power", text(settings.target), "", "The share of studies that is asked for."},
        {"equivalence", settings.equivalence ? text(*settings.equivalence) : std::string("none"), "",
         "In standard deviations of observers' differences: a study has found that the effect is smaller, if "
         "p of "
         "equivalence is at most alpha; none: that there is an effect."},
        {"sequential", settings.sequential ? std::string(name_of(*settings.sequential)) : std::string("none"),
         "",
         "How alpha is spent over looks with each number of observers; none: studies are not looked at "
         "before "
         "their end."},
        {"area-shares", fmt::format("{}", fmt::join(shares, ", ")), "",
         "Shares of fixations on areas, of the protocol's tasks (simulated_head_share, "
         "simulated_area_shares)."},
        {"head-share-sd", text(settings.gaze.head_share_sd), "",
         "Standard deviation over observers of the logit of their shares of fixations on the head, and on "
         "each other "
         "area with a share."},
        {"accuracy", text(settings.gaze.accuracy_deg), "deg",
         "Standard deviation along each axis of the tracker's constant error in a trial."},
        {"sigma", text(settings.gaze.sigma.value), settings.gaze.sigma.is_mm ? "mm" : "deg",
         "Standard deviation of the maps' kernel."},
        {"permutations", text(settings.permutations), "", "Random ones, where there are too many for all."},
        {"seed", text(settings.seed), "", "Of all that is drawn at random."}};
}

void check(const Protocol& protocol, const std::vector<PowerEffect>& effects, const PowerSettings& settings) {
    if (settings.equivalence && settings.sequential)
        throw InputError(
            "--sequential: looks are for studies that are to find an effect; without --equivalence it "
            "goes.");
    for (const PowerEffect& effect : effects) {
        if (settings.equivalence && effect.test != PowerTest::pair)
            throw InputError(fmt::format("--equivalence: not of {}: its test is of no single difference. "
                                         "Without :test=… it goes.",
                                         effect.text()));
        if (settings.equivalence && effect.measure == PowerMeasure::cc)
            throw InputError(
                fmt::format("--equivalence: not of {}: maps of all observers are no differences of "
                            "observers. Name head, area=NAME, wss or a measure of answers; a size of "
                            "none is odds=1 or ratio=1.",
                            effect.text()));
    }
    if (const auto capacity = group_capacity(protocol); capacity && settings.observers.back() > *capacity)
        throw InputError(fmt::format("--observers: the protocol's groups take {}, and not {}.",
                                     counted(*capacity, "observer"), settings.observers.back()));
    if (settings.alpha * (settings.permutations + 1.0) < 1.0)
        throw InputError(fmt::format("--alpha {}: {} permutations cannot give a p as small as that.",
                                     settings.alpha, settings.permutations));
}

/// Effects that are simulated together: those that are none; each other one alone, so that none acts on
/// what another one's test finds.
std::vector<std::vector<std::size_t>> batches_of(const std::vector<PowerEffect>& effects) {
    std::vector<std::vector<std::size_t>> batches;
    std::vector<std::size_t> without;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        if (effects[i].is_none() && effects[i].sd == 0.0 && !is_of_answers(effects[i].measure))
            without.push_back(i);
        else
            batches.push_back({i});
    }
    if (!without.empty())
        batches.push_back(std::move(without));
    return batches;
}

std::vector<PowerCurve> empty_curves(const Protocol& protocol, const std::vector<PowerEffect>& effects,
                                     const PowerSettings& settings) {
    std::vector<PowerCurve> curves;
    for (const PowerEffect& effect : effects) {
        PowerCurve curve{effect,
                         analysis_of(protocol, effect, settings.equivalence.has_value()),
                         planted_words(effect),
                         {}};
        for (const int count : settings.observers) {
            curve.points.emplace_back();
            curve.points.back().observers = count;
            curve.points.back().studies.resize(static_cast<std::size_t>(settings.studies));
        }
        curves.push_back(std::move(curve));
    }
    return curves;
}

using AllMaps = std::vector<std::unique_ptr<VertexMaps>>;

/// For effects on CC alone.
AllMaps maps_for(const Experiment& experiment, const std::vector<PowerEffect>& effects,
                 const PowerSettings& settings, const PowerProgress& progress) {
    AllMaps maps(experiment.objects.size());
    if (std::ranges::none_of(effects, [](auto& effect) { return effect.measure == PowerMeasure::cc; }))
        return maps;
    const auto report = [&](std::size_t done) {
        progress("maps of single fixations", static_cast<int>(done), static_cast<int>(maps.size()));
    };
    const GazeStudies studies(experiment, {}, settings.gaze);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        report(i);
        if (const auto& scale = studies.surfaces()[i].scale)
            maps[i] = std::make_unique<VertexMaps>(experiment.objects[i].mesh, *scale, settings.gaze.sigma,
                                                   settings.jobs);
    }
    report(maps.size());
    return maps;
}

/// Simulates the studies of one batch and tests its effects.
void simulate(const GazeStudies& studies, std::span<PowerCurve* const> curves, const AllMaps& maps,
              const PowerSettings& settings, const std::function<void()>& one_done) {
    std::mutex reporting;
    parallel_for(
        settings.studies,
        [&](int number) {
            const auto study = static_cast<std::size_t>(number);
            RandomStream random(settings.seed, "seeds of studies", study);
            const std::uint64_t high = random.next_bits(), seed = high << 32 | random.next_bits();
            const StudyResults simulated = studies.study(seed, settings.observers.back());
            for (PowerCurve* curve : curves) {
                const std::vector<StudyOutcome> outcomes = tested(
                    studies, simulated, curve->effect, settings.observers, maps,
                    {settings.permutations, PermutationSettings{}.most_exact, seed}, settings.equivalence);
                for (std::size_t i = 0; i < outcomes.size(); ++i)
                    curve->points[i].studies[study] = outcomes[i];
            }
            const std::scoped_lock lock(reporting);
            one_done();
        },
        settings.jobs);
}

/// The studies of one effect on answers.
void simulate_answers(const AnswerStudies& studies, PowerCurve& curve, const PowerSettings& settings,
                      const std::function<void()>& one_done) {
    std::mutex reporting;
    parallel_for(
        settings.studies,
        [&](int number) {
            const auto study = static_cast<std::size_t>(number);
            RandomStream random(settings.seed, "seeds of studies", study);
            const std::uint64_t high = random.next_bits(), seed = high << 32 | random.next_bits();
            const std::vector<StudyOutcome> outcomes = studies.tested(
                studies.study(seed, settings.observers.back()), settings.observers,
                {settings.permutations, PermutationSettings{}.most_exact, seed}, settings.equivalence);
            for (std::size_t i = 0; i < outcomes.size(); ++i)
                curve.points[i].studies[study] = outcomes[i];
            const std::scoped_lock lock(reporting);
            one_done();
        },
        settings.jobs);
}

/// What a reader must know.
void add_remarks(PowerResults& results, const Protocol& protocol, const PowerSettings& settings) {
    for (const PowerCurve& curve : results.curves) {
        const PowerPoint& most = curve.points.back();
        if (most.without_test > 0)
            results.remarks.push_back(fmt::format(
                "{} of {} studies with {} have nothing to test for {}: {}.", most.without_test,
                settings.studies, counted(most.observers, "observer"), curve.effect.text(),
                is_of_answers(curve.effect.measure)
                    ? "fewer than two observers have the measure in both levels"
                : curve.effect.column != "task" ? "no observer sees an object in both levels under one task"
                                                : "no observer sees an object in both levels"));
    }
    for (const PowerCurve& curve : results.curves) {
        const PowerPoint& most = curve.points.back();
        if (most.without_measure == 0)
            continue;
        const int simulated = settings.studies * most.observers;
        const bool is_fitted =
            curve.effect.measure == PowerMeasure::threshold || curve.effect.measure == PowerMeasure::slope;
        results.remarks.push_back(fmt::format(
            "{}: {} of {} ({:.1f} %) {} in both levels, and the tests are without them.", curve.effect.text(),
            most.without_measure, counted(simulated, "simulated observer"),
            100.0 * most.without_measure / simulated,
            is_fitted ? "have no function that can be fitted, with a threshold among the levels or near them,"
                      : "do not have the measure"));
    }
    if (const int fewest = fewest_testable_observers(settings.alpha);
        !settings.equivalence && settings.observers.front() < fewest)
        results.remarks.push_back(fmt::format(
            "With fewer than {} observers the tests cannot give p at most {}: 2 / 2^n is the least.", fewest,
            settings.alpha));
    if (!results.curves.empty() && results.curves.front().sequential) {
        const std::vector<double>& levels = results.curves.front().sequential->levels;
        int cannot = 0;
        for (std::size_t look = 0; look < levels.size(); ++look)
            cannot += settings.observers[look] < fewest_testable_observers(levels[look]);
        if (cannot > 0)
            results.remarks.push_back(
                fmt::format("No study can end at the first {}: with so few observers no test "
                            "has a p as small as its level there.",
                            counted(cannot, "look")));
    }
    const auto is_of_gaze = [](const PowerCurve& curve) { return !is_of_answers(curve.effect.measure); };
    const bool any_of_gaze = std::ranges::any_of(results.curves, is_of_gaze);
    for (const PowerCurve& curve : results.curves)
        if (!is_of_gaze(curve) && asked_answer(protocol, curve.effect).truth.observer_sd == 0.0) {
            results.remarks.emplace_back(
                "Observers differ by chance alone in what they answer: `simulated` of the answer has no "
                "observer_sd. Differences between levels differ over observers with :sd=… alone.");
            break;
        }
    if (any_of_gaze && settings.gaze.head_share_sd == 0.0)
        results.remarks.emplace_back(
            "Observers differ by chance alone: the protocol has no head_share_sd, and --head-share-sd sets "
            "none. Real observers differ more, so that real studies find less.");
    if (std::ranges::any_of(results.curves, [](auto& curve) { return !curve.effect.is_none(); }) &&
        std::ranges::none_of(results.curves, [](auto& curve) { return curve.effect.sd > 0.0; }))
        results.remarks.emplace_back("The effect is the same for all observers; :sd=… lets it differ.");
    if (!protocol.simulated_effects.empty())
        results.remarks.emplace_back("The protocol's own [[simulated_effect]]s are left out: only what "
                                     "--effect says is planted.");
}

} // namespace

PowerResults simulate_power(const Experiment& experiment, const std::vector<PowerEffect>& effects,
                            const PowerSettings& settings, const PowerProgress& progress) {
    const Protocol& protocol = experiment.protocol;
    check(protocol, effects, settings);
    PowerResults results;
    results.equivalence = settings.equivalence;
    results.sequential = settings.sequential;
    results.protocol = protocol.title.empty() ? protocol.name : protocol.title;
    results.trials = trial_count(protocol, 1);
    results.planned = protocol.schedule.observers;
    results.studies = settings.studies;
    results.alpha = settings.alpha;
    results.target = settings.target;
    results.parameters = parameters_of(protocol, settings);
    results.curves = empty_curves(protocol, effects, settings);
    const AllMaps maps = maps_for(experiment, effects, settings, progress);
    const std::vector<std::vector<std::size_t>> batches = batches_of(effects);
    const int all = settings.studies * static_cast<int>(batches.size());
    int done = 0;
    for (const std::vector<std::size_t>& batch : batches) {
        if (is_of_answers(effects[batch.front()].measure)) {
            simulate_answers(AnswerStudies(protocol, effects[batch.front()]), results.curves[batch.front()],
                             settings, [&] { progress("studies", ++done, all); });
            continue;
        }
        std::vector<PowerEffect> own;
        std::vector<PowerCurve*> curves;
        for (const std::size_t i : batch) {
            own.push_back(effects[i]);
            curves.push_back(&results.curves[i]);
        }
        GazeStudies studies(experiment, own, settings.gaze);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (own[i].measure == PowerMeasure::wss)
                curves[i]->planted = plant_spread(studies, i, settings.seed, settings.jobs);
        }
        simulate(studies, curves, maps, settings, [&] { progress("studies", ++done, all); });
    }
    for (PowerCurve& curve : results.curves) {
        summarise(curve, settings.alpha);
        if (settings.sequential)
            curve.sequential = with_looks(curve, settings.alpha, *settings.sequential);
    }
    add_remarks(results, protocol, settings);
    return results;
}

} // namespace overt
