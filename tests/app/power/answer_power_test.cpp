/// Studies simulated by their answers: they find what is planted, of the size that was planted, and nothing
/// else.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "app/power/answer_studies.h"
#include "app/power/power_simulation.h"
#include "experiment/answers/answer_kinds.h"
#include "experiment/base/error.h"

using namespace overt;

namespace {

AnswerKind answer_kind_called(std::string_view name) {
    std::size_t kind = 0;
    while (kinds_of<AnswerKind>[kind].name != name)
        ++kind;
    return static_cast<AnswerKind>(kind);
}

/// Six levels of roughness on two objects, each eight times, judged "glossy" or "matt", rated from 1 to 7,
/// and told metal from stone.
Experiment judged() {
    Experiment experiment;
    Protocol& protocol = experiment.protocol;
    protocol.name = "judged";
    protocol.objects.resize(2);
    protocol.objects[0].id = "bust";
    protocol.objects[1].id = "cow";
    for (int i = 1; i <= 6; ++i) {
        auto& material = protocol.materials.emplace_back();
        material.id = fmt::format("gold_{}", i);
        material.columns = {{"roughness", fmt::format("0.{}", i), 0.1 * i}};
    }
    Task task;
    task.id = "judge";
    TaskAnswer word;
    word.id = "looks";
    word.kind = answer_kind_called("choice");
    word.choices = {"matt", "glossy"};
    word.keys = {"f", "j"};
    word.truth.by = "roughness";
    // From level to level by 0.8 of a standard deviation: with 8 answers each, nearly all observers (98 of
    // 100) answer at two levels or more neither always nor never, without which no slope and no threshold is
    // told.
    word.truth.slope = 8.0;
    word.truth.offset = 0.35;
    word.truth.observer_sd = 0.5;
    TaskAnswer rating;
    rating.id = "gloss";
    rating.kind = answer_kind_called("scale");
    rating.steps = 7;
    rating.truth.offset = 4.0;
    rating.truth.noise = 1.0;
    rating.truth.observer_sd = 0.5;
    TaskAnswer kind;
    kind.id = "kind";
    kind.kind = answer_kind_called("choice");
    kind.choices = {"metal", "stone"};
    kind.keys = {"d", "k"};
    kind.correct = "metal";
    kind.truth.share_correct = 0.75;
    task.answers = {word, rating, kind};
    task.repetitions = 8;
    protocol.tasks = {task};
    protocol.schedule.max_object_run = 0;
    return experiment;
}

PowerCurve answer_power_of(const Experiment& experiment, const std::string& effect, int studies,
                           std::vector<int> observers = {8}, int jobs = 0) {
    PowerSettings settings;
    settings.observers = std::move(observers);
    settings.studies = studies;
    settings.jobs = jobs;
    return simulate_power(experiment, power_effects({effect}, experiment.protocol, {}), settings,
                          [](std::string_view, int, int) {})
        .curves.front();
}

} // namespace

TEST_CASE("thresholds, shares of correct answers and ratings are found of the size that was planted",
          "[unit]") {
    const Experiment experiment = judged();
    // A threshold of matt over roughness rises by what is planted, however observers differ.
    const PowerCurve threshold = answer_power_of(experiment, "threshold:object=cow:shift=0.08", 30);
    // With binomial answers 0.976 of such studies find it: no test of signs is below 0.05 with fewer than 6
    // observers who have both thresholds.
    CHECK(threshold.points[0].share() > 0.9);
    CHECK(threshold.points[0].median_estimate == Approx(0.08).margin(0.01));
    CHECK(threshold.analysis.find("threshold of roughness") != std::string::npos);
    const PowerCurve lower = answer_power_of(experiment, "threshold:object=bust:shift=-0.08", 10);
    CHECK(lower.points[0].median_estimate == Approx(-0.08).margin(0.015));
    // Half as steep, since levels are too coarse for steeper ones. With binomial answers as few, fitted by a
    // logistic function, the difference is off by -0.09; the median of 20 studies has an error of 0.05.
    const PowerCurve slope = answer_power_of(experiment, "slope:object=cow:ratio=0.5", 20);
    CHECK(slope.points[0].median_estimate == Approx(std::log(0.5)).margin(0.25));
    // 48 answers each: from odds of 3 to 6, shares of 0.75 and 0.857.
    const PowerCurve correct = answer_power_of(experiment, "correct:object=cow:odds=2", 40);
    CHECK(correct.points[0].median_estimate == Approx(6.0 / 7.0 - 0.75).margin(0.015));
    const PowerCurve rating = answer_power_of(experiment, "rating:object=cow:shift=0.5", 30);
    CHECK(rating.points[0].share() > 0.9);
    CHECK(rating.points[0].median_estimate == Approx(0.5).margin(0.06));
    const PowerCurve choice = answer_power_of(experiment, "choice:object=cow:shift=1", 20);
    CHECK(choice.points[0].share() > 0.9);
    // The first by its letters is glossy, which comes second in the protocol.
    CHECK(choice.points[0].median_estimate > 0.1);
}

TEST_CASE("it is told for how many simulated observers no threshold could be fitted", "[unit]") {
    Experiment experiment = judged();
    // A step between two levels: nearly nobody answers at two levels neither always nor never.
    experiment.protocol.tasks[0].answers[0].truth.slope = 400.0;
    PowerSettings settings;
    settings.observers = {6};
    settings.studies = 2;
    const PowerResults results = simulate_power(
        experiment, power_effects({"threshold:object=cow:shift=0.08"}, experiment.protocol, {}), settings,
        [](std::string_view, int, int) {});
    const PowerPoint& point = results.curves.front().points.front();
    CHECK(point.without_measure >= 10);
    CHECK(point.without_measure <= 12);
    CHECK_THAT(results.remarks, Catch::Matchers::VectorContains(fmt::format(
                                    "threshold:object=cow:shift=0.08:against=bust:answer=looks: {} of 12 "
                                    "simulated observers ({:.1f} %) "
                                    "have no function that can be fitted, with a threshold among the levels "
                                    "or near them, in both levels, and the tests are without them.",
                                    point.without_measure, 100.0 * point.without_measure / 12)));
    // A rating is everybody's.
    CHECK(answer_power_of(judged(), "rating:object=cow:shift=0.5", 3).points[0].without_measure == 0);
}

TEST_CASE("without an effect answers differ as seldom as the level says, whatever the threads", "[unit]") {
    const Experiment experiment = judged();
    const PowerCurve none = answer_power_of(experiment, "rating:object=cow:shift=0", 200, {8}, 1);
    // 99.9 % of a binomial distribution with 5 %.
    CHECK(none.points[0].found <= 21);
    CHECK(std::abs(none.points[0].median_estimate) < 0.05);
    const PowerCurve again = answer_power_of(experiment, "rating:object=cow:shift=0", 200, {8}, 2);
    CHECK(again.points[0].found == none.points[0].found);
    // More observers find more, and have the first of the others.
    const PowerCurve more = answer_power_of(experiment, "rating:object=cow:shift=0.15", 60, {6, 14});
    CHECK(more.points[1].found > more.points[0].found);
    // Where the effect differs between observers as much as it is large, it is found less often.
    const PowerCurve differs = answer_power_of(experiment, "rating:object=cow:shift=0.5:sd=0.8", 60, {8});
    CHECK(differs.points[0].share() < 0.8);
}

TEST_CASE("effects on answers that nothing is known of are refused with what there is", "[unit]") {
    const Protocol protocol = judged().protocol;
    const auto said = [&](const std::string& effect) -> std::string {
        try {
            (void)power_effects({effect}, protocol, {});
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    };
    CHECK(said("threshold:object=cow:shift=0.1").empty());
    CHECK(said("dprime:object=cow:odds=2:answer=kind").empty());
    CHECK(said("threshold:object=cow:ratio=2").find("with shift=") != std::string::npos);
    CHECK(said("rating:object=cow:shift=1:answer=looks").find("but of gloss") != std::string::npos);
    CHECK(said("rating:object=cow").find("shift=") != std::string::npos);
    CHECK(said("correct:object=horse:odds=2").find("bust, cow") != std::string::npos);
    const PowerEffect effect = power_effects({"correct:object=cow:odds=2"}, protocol, {}).front();
    CHECK(effect.answer == "kind");
    CHECK(power_effects({effect.text()}, protocol, {}).front().text() == effect.text());
    CHECK(effect.words() == "share of correct answers to \"kind\", object cow against bust");
}
