/// What is written on the command line of a plan, and what is said of its studies.
#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/power/power_results.h"
#include "experiment/statistics/permutation.h"

using namespace overt;
using Catch::Contains;

namespace {

const std::vector<std::string> areas{"body", "head", "rim"};

Protocol small_plan() {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}, {"age", "How old?"}};
    protocol.materials.resize(3);
    protocol.materials[0].id = "smooth";
    protocol.materials[1].id = "rough";
    protocol.materials[2].id = "coated";
    protocol.objects.resize(1);
    protocol.objects[0].id = "runner";
    return protocol;
}

PowerEffect effect_of(const std::string& text) { return power_effects({text}, small_plan(), areas).at(0); }

std::string fault_of(const std::string& text) {
    try {
        effect_of(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

} // namespace

TEST_CASE("an effect is read with its measure, its levels and its size", "[unit]") {
    const PowerEffect head = effect_of("head:material=rough:odds=1.5");
    CHECK(head.measure == PowerMeasure::area);
    CHECK(head.area == "head");
    CHECK(head.column == "material");
    CHECK(head.level == "rough");
    CHECK(head.against == "smooth");
    CHECK(head.size == 1.5);
    CHECK_FALSE(head.is_none());

    const PowerEffect wss = effect_of("wss:material=smooth:task=age:ratio=1.2:sd=0.1:against=coated");
    CHECK(wss.measure == PowerMeasure::wss);
    CHECK(wss.against == "coated");
    CHECK(wss.within == std::vector<StudyKey>{{"task", "age"}});
    CHECK(wss.sd == 0.1);
    CHECK(effect_of("cc:task=free:share=0").is_none());
    CHECK(effect_of("cc:task=free:share=0").against == "age");
    // Where the object stands first, the factor is the material all the same.
    CHECK(effect_of("head:object=runner:material=rough:odds=2").column == "material");
    for (const std::string text : {"head:material=rough:odds=1.5", "wss:task=age:material=rough:ratio=0.7",
                                   "cc:material=coated:share=0.2:sd=0.05"})
        CHECK(effect_of(effect_of(text).text()).text() == effect_of(text).text());
}

TEST_CASE("an effect on gaze names its test", "[unit]") {
    CHECK(effect_of("head:material=rough:odds=1.5").test == PowerTest::pair);
    const PowerEffect factor = effect_of("head:material=rough:odds=1.5:test=factor");
    CHECK(factor.test == PowerTest::factor);
    const PowerEffect both = effect_of("wss:material=rough:task=free:ratio=1.5:test=interaction");
    CHECK(both.test == PowerTest::interaction);
    CHECK(both.interacting_column() == "task");
    CHECK_THAT(both.words(), Contains("by the interaction of material and task"));
    CHECK(effect_of(both.text()).test == PowerTest::interaction);
    CHECK(effect_of("cc:material=rough:share=0.2:test=cluster").test == PowerTest::cluster);
    CHECK_THAT(fault_of("head:material=rough:odds=2:test=t"), Contains("pair, factor, interaction, cluster"));
    CHECK_THAT(fault_of("head:material=rough:odds=2:test=cluster"), Contains("clusters are of maps"));
    CHECK_THAT(fault_of("cc:material=rough:share=0.2:test=factor"), Contains("maps have no test of factors"));
    CHECK_THAT(fault_of("cc:material=rough:task=free:share=0.2:test=cluster"), Contains("of all trials"));
    CHECK_THAT(fault_of("head:material=rough:odds=2:test=interaction"),
               Contains("one other factor confines"));
    CHECK_THAT(fault_of("head:material=rough:object=runner:odds=2:test=interaction"),
               Contains("not of objects"));
}

TEST_CASE("an effect is in a level of any factor of the protocol", "[unit]") {
    Protocol protocol = small_plan();
    protocol.materials[1].columns = {{"gloss", "0.2", 0.2}};
    protocol.motions[0].id = "motion";
    protocol.lights.resize(2);
    protocol.lights[0].id = "sky";
    protocol.lights[1].id = "hall";
    const PowerEffect light = power_effects({"head:light=hall:odds=2:gloss=0.2"}, protocol, areas).at(0);
    CHECK(light.column == "light");
    CHECK(light.against == "sky");
    CHECK(light.within == std::vector<StudyKey>{{"gloss", "0.2"}});
    CHECK(power_effects({"wss:gloss=0.2:ratio=2"}, protocol, areas).at(0).against == "n/a");
    CHECK_THROWS_WITH(power_effects({"head:motion=motion:odds=2"}, protocol, areas),
                      Contains("the protocol has only one motion"));
}

TEST_CASE("no effect is tested between the first materials and the first tasks", "[unit]") {
    const std::vector<PowerEffect> none = power_effects({"none"}, small_plan(), areas);
    REQUIRE(none.size() == 4);
    for (const PowerEffect& effect : none)
        CHECK(effect.is_none());
    CHECK(none[2].measure == PowerMeasure::cc);
    CHECK(none[3].column == "task");
    CHECK_THROWS_AS(power_effects({"none", "head:material=rough:odds=2"}, small_plan(), areas), InputError);
    Protocol single = small_plan();
    single.materials.resize(1);
    single.tasks.resize(1);
    CHECK_THROWS_AS(power_effects({"none"}, single, areas), InputError);
}

TEST_CASE("what is wrong with an effect is said with what is known", "[unit]") {
    CHECK_THAT(fault_of("had:material=rough:odds=2"), Contains("head, area=NAME, wss or cc"));
    CHECK_THAT(fault_of("head:material=ruff:odds=2"), Contains("no material \"ruff\"; it has smooth, rough"));
    CHECK_THAT(fault_of("head:materiel=rough:odds=2"), Contains("\"materiel\" is no key of area"));
    CHECK_THAT(fault_of("head:material=rough:ratio=2"), Contains("whose keys are"));
    CHECK_THAT(fault_of("head:material=rough"), Contains("how large the effect is: odds="));
    CHECK_THAT(fault_of("head:odds=2"), Contains("in which material or task"));
    CHECK_THAT(fault_of("head:object=runner:odds=2"), Contains("in which material or task"));
    CHECK_THAT(fault_of("head:material=rough:odds=0"), Contains("a number from 0.01 to 100"));
    CHECK_THAT(fault_of("head:material=rough:odds=nan"), Contains("and not \"nan\""));
    CHECK_THAT(fault_of("head:material=rough:odds=2x"), Contains("and not \"2x\""));
    CHECK_THAT(fault_of("cc:material=rough:share=0.99"), Contains("from 0 to 0.95"));
    CHECK_THAT(fault_of("head:material=rough:odds=2:odds=3"), Contains("odds is given twice"));
    CHECK_THAT(fault_of("head:material=rough:against=rough:odds=2"), Contains("compared with itself"));
    CHECK_THAT(fault_of("head:material=rough:odds"), Contains("not of the form key=value"));
    CHECK_THAT(fault_of(""), Contains("head, area=NAME, wss or cc"));
}

TEST_CASE("numbers of observers are a number, a range or a list", "[unit]") {
    CHECK(observer_counts("12") == std::vector{12});
    CHECK(observer_counts("6:9") == std::vector{6, 7, 8, 9});
    CHECK(observer_counts("6:24:8") == std::vector{6, 14, 22});
    CHECK(observer_counts("18,6,12,6") == std::vector{6, 12, 18});
    for (const std::string text : {"", "0", "-3", "6:", "9:6", "6:9:0", "6:9:1:1", "a", "6,", "501", "6.5"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(observer_counts(text), InputError);
    }
}

TEST_CASE("the fewest observers are those from whom on the share stays above the target", "[unit]") {
    PowerCurve curve{effect_of("head:material=rough:odds=2"), "", "", {}};
    const int found[] = {10, 82, 75, 85, 95};
    for (int i = 0; i < 5; ++i) {
        PowerPoint point;
        point.observers = 6 + 2 * i;
        for (int study = 0; study < 100; ++study)
            point.studies.push_back({study < found[i] ? 0.05 : 0.051, 0.1});
        curve.points.push_back(std::move(point));
    }
    summarise(curve, 0.05);
    CHECK(curve.points[1].found == 82);
    CHECK(curve.points[1].share() == 0.82);
    // statsmodels.stats.proportion.proportion_confint(82, 100, method="wilson")
    CHECK(curve.points[1].interval.low == Approx(0.733326).margin(1e-5));
    CHECK(curve.points[1].interval.high == Approx(0.882998).margin(1e-5));
    CHECK(observers_needed(curve, 0.8) == 12);
    CHECK_FALSE(observers_needed(curve, 0.99));
    PowerResults results;
    CHECK_THAT(answer_of(curve, results), Contains("With 12 observers, 85 % of 100 simulated studies (95 % "
                                                   "interval 77 to 91 %) found the effect"));
    CHECK_THAT(answer_of(curve, results), Contains("80 % needs 12 observers."));
    results.planned = 8;
    CHECK_THAT(answer_of(curve, results), Contains("With 8 observers, 82 % of 100 simulated studies"));
    CHECK_THAT(answer_of(curve, results), Contains("80 % needs 12 observers."));
    results.target = 0.99;
    CHECK_THAT(answer_of(curve, results), Contains("99 % was not reached with up to 14 observers."));

    curve.points[0].studies[0].p.reset();
    summarise(curve, 0.05);
    CHECK(curve.points[0].found == 9);
    CHECK(curve.points[0].without_test == 1);
}

TEST_CASE("with fewer observers than are said, flips of signs cannot find anything", "[unit]") {
    for (const double alpha : {0.5, 0.05, 0.01, 0.001}) {
        const auto fewest = static_cast<std::size_t>(fewest_testable_observers(alpha));
        CHECK(sign_flip_test(std::vector<double>(fewest, 1.0))->p <= alpha);
        const auto of_fewer = sign_flip_test(std::vector<double>(fewest - 1, 1.0)); // of one there is none
        CHECK((!of_fewer || of_fewer->p > alpha));
    }
}

TEST_CASE("flips of signs have the power of a paired t test of normal differences", "[unit]") {
    // scipy: 12 differences with mean 0.8 and sd 1, nc = 0.8 sqrt(12), c = t.ppf(0.975, 11):
    // 1 - nct.cdf(c, 11, nc) + nct.cdf(-c, 11, nc)
    constexpr double power_of_t = 0.713660;
    int found = 0;
    constexpr int studies = 1000;
    for (int study = 0; study < studies; ++study) {
        RandomStream random(11, "differences", static_cast<std::uint64_t>(study));
        std::vector<double> differences;
        for (int i = 0; i < 12; ++i)
            differences.push_back(0.8 + random.normal());
        found += sign_flip_test(differences)->p <= 0.05;
    }
    // Four standard errors of a share of 1,000, and 0.02 by which the tests themselves may differ.
    CHECK(found / static_cast<double>(studies) == Approx(power_of_t).margin(0.078));
}

TEST_CASE("a study that is to show that an effect is smaller has the p of equivalence", "[unit]") {
    // d_z of 0.1, far below 0.5, of few and of many observers.
    std::vector<double> differences;
    for (int i = 0; i < 200; ++i)
        differences.push_back(0.1 + (i % 2 == 0 ? 1.0 : -1.0));
    const std::span<const double> all(differences);
    const StudyOutcome none = outcome_of(all, {}, 0.5), difference = outcome_of(all, {}, {});
    CHECK(*none.p < 0.001);
    CHECK(*none.estimate == Approx(0.1));
    CHECK(*difference.p > 0.05);
    CHECK(*difference.estimate == Approx(0.1));
    CHECK(*outcome_of(all.first(8), {}, 0.5).p > 0.05); // so few cannot show it
    CHECK(*outcome_of(all, {}, 0.05).p > 0.5);          // for it is larger
    CHECK_FALSE(outcome_of(all.first(1), {}, 0.5).p);
    PowerCurve curve;
    curve.points.push_back({12, std::vector<StudyOutcome>(10, StudyOutcome{0.01, 0.1}), 0, 0, 0, {}, 0.0});
    summarise(curve, 0.05);
    PowerResults results;
    results.equivalence = 0.5;
    CHECK_THAT(answer_of(curve, results), Contains("showed that the effect on the"));
    CHECK_THAT(answer_of(curve, results), Contains("is smaller than 0.5 standard deviations"));
}
