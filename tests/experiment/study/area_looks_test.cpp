/// What is reckoned of areas, by hand.
#include "experiment/study/area_looks.h"

#include <array>
#include <map>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/statistics/proportion.h"
#include "experiment/study/area_pairs.h"
#include "experiment/study/area_shares.h"
#include "experiment/study/surface_transitions.h"

using namespace overt;

namespace {

/// Parts of an object: 0 rest, 1 rim, 2 rim and handle, 3 base.
const std::vector<std::string> parts{"body", "rim", "rim/handle", "base"};

struct Looked {
    int part; ///< -1: beside the object
    double seconds = 0.25;
};

/// An object with areas and one without the base, so many observers with the same trials on either.
class LookedStudy {
  public:
    explicit LookedStudy(int observers, const std::vector<std::vector<Looked>>& trials, int of_object = 0) {
        for (const std::size_t count : {parts.size(), parts.size() - 1}) {
            StudyObject& object = results.objects.emplace_back();
            object.id = count == parts.size() ? "vase" : "bowl";
            object.part_names.assign(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count));
            object.areas = Areas(object.part_names);
            object.mm_per_unit = 1.0;
        }
        for (int observer = 0; observer < observers; ++observer) {
            results.sessions.emplace_back().observer = std::to_string(observer);
            for (const std::vector<Looked>& looks : trials)
                add(observer, looks, of_object);
        }
        name_areas(results, options);
        results.groups = make_groups(results, {}, {});
    }

    void add(int observer, const std::vector<Looked>& looks, int object) {
        StudyTrial trial;
        trial.session = observer;
        trial.object = object;
        trial.presentation_s = 8.0;
        trial.keys = {{"observer", std::to_string(observer)}};
        trial.first_fixation = results.fixations.size();
        trial.fixations = looks.size();
        double at = 0.5;
        for (const Looked& look : looks) {
            StudyFixation& fixation = results.fixations.emplace_back();
            fixation.trial = static_cast<int>(results.trials.size());
            fixation.onset_s = at;
            fixation.duration_s = look.seconds;
            at += look.seconds + 0.25;
            if (look.part < 0)
                fixation.why = NotCounted::not_on_surface;
            else
                fixation.part = static_cast<PartIndex>(look.part);
        }
        results.trials.push_back(std::move(trial));
    }

    const AreaRow& row(const std::string& area) {
        results.area_rows = area_rows(results, {}, options);
        const auto found = std::ranges::find(results.area_rows, area, &AreaRow::area);
        REQUIRE(found != results.area_rows.end());
        return *found;
    }

    StudyResults results;
    StudyOptions options = [] {
        StudyOptions all;
        all.by.clear();
        return all;
    }();
};

} // namespace

TEST_CASE("dwell, visits and arrivals are those of runs of fixations on an area", "[unit]") {
    // Rest, rim, its handle, beside, rim, rest, base: at 0.5, 1.0, 1.5, 2.25, 2.75, 3.25, 3.75 s.
    const LookedStudy study(1, {{{0}, {1}, {2, 0.5}, {-1}, {1}, {0}, {3, 1.0}}});
    const StudyTrial& trial = study.results.trials[0];
    const auto look = [&](const char* area) { return *area_look(study.results, trial, area); };
    // What lies in the rim counts for it; what is beside the object ends a visit.
    CHECK(look("rim").dwell_s == Approx(1.0));
    CHECK(look("rim").visits == 2);
    CHECK(*look("rim").first_arrival_s == Approx(1.0));
    CHECK(look("rim").first_arrival_number == 2);
    CHECK(look("handle").visits == 1);
    CHECK(look("handle").dwell_s == Approx(0.5));
    CHECK(look("handle").first_arrival_number == 3);
    CHECK(look("base").first_arrival_number == 6); // of those that count
    CHECK(*look("base").first_arrival_s == Approx(3.75));
    CHECK_FALSE(area_look(study.results, trial, "spout"));
    const LookedStudy other(1, {{{0}, {1}}}, 1);
    CHECK_FALSE(area_look(other.results, other.results.trials[0], "base"));
}

TEST_CASE("a trial whose gaze never comes to an area counts with its whole presentation", "[unit]") {
    // Base after 0.5 s and never; rim never.
    LookedStudy study(4, {{{3}, {3}, {0}}, {{0}}});
    const AreaRow base = study.row("base"), rim = study.row("rim");
    CHECK(*base.first_arrival_s.value == Approx(0.5 * (0.5 + 8.0)));
    CHECK(*base.reached.value == 0.5);
    CHECK(*base.first_arrival_number.value == 1.0);
    CHECK(*base.visits.value == 0.5);
    CHECK(*base.visit_s.value == Approx(0.5));
    CHECK(*base.dwell_s.value == Approx(0.25));
    CHECK(base.looks == 8);
    CHECK(base.arrivals == 4);
    CHECK(*rim.first_arrival_s.value == 8.0);
    CHECK(*rim.reached.value == 0.0);
    CHECK_FALSE(rim.first_arrival_number.value);
    CHECK_FALSE(rim.visit_s.absent.empty());
}

TEST_CASE("shares are of fixations on objects that have the area, and held against its size and exposure",
          "[unit]") {
    LookedStudy study(3, {{{1}, {2}, {3}, {0}}});
    for (int observer = 0; observer < 3; ++observer)
        study.add(observer, {{1}, {1}, {1}, {1}}, 1); // on the bowl, which has no base
    ExposureRow of_base;
    of_base.area = "base";
    of_base.share_of_area = 0.5;
    of_base.share_of_exposure = 0.125;
    study.results.exposures = {of_base};
    study.results.groups = make_groups(study.results, {}, {});
    CHECK(study.results.areas == std::vector<std::string>{"body", "rim", "handle", "base"});
    CHECK(study.results.area == "rim"); // there is no head
    CHECK(*study.row("rim").by_count.value == Approx(6.0 / 8.0));
    CHECK(*study.row("handle").by_count.value == Approx(1.0 / 8.0));
    const AreaRow base = study.row("base");
    CHECK(*base.by_count.value == 0.25);
    CHECK(base.fixations == 12);
    CHECK(*base.over_surface.value == Approx(0.5));
    CHECK(*base.over_exposure.value == Approx(2.0));
    CHECK_FALSE(study.row("rim").over_exposure.value); // nobody said what of it is seen
    study.options.areas = {"base", "rim"};
    name_areas(study.results, study.options);
    CHECK(study.results.area == "base");
    CHECK(study.results.compared_areas.size() == 2);
    study.options.areas = {"spout"};
    CHECK_THROWS_WITH(name_areas(study.results, study.options),
                      Catch::Contains("spout") && Catch::Contains("body, rim, handle, base"));
}

TEST_CASE(
    "shares are means over observers of their own, by number and by time, and of all fixations together",
    "[unit]") {
    // Of the rim: one of three and two of four fixations; 0.5 of 1.75 s and 0.75 of 1.25 s.
    LookedStudy study(2, {});
    study.add(0, {{1, 0.5}, {0, 0.25}}, 0);
    study.add(0, {{3, 1.0}}, 0);
    study.add(1, {{0, 0.25}, {0, 0.25}, {1, 0.5}, {2, 0.25}}, 0);
    name_areas(study.results, study.options);
    study.results.groups = make_groups(study.results, {}, {});
    const AreaRow rim = study.row("rim");
    CHECK(*rim.by_count.value == Approx((1.0 / 3.0 + 1.0 / 2.0) / 2.0));
    CHECK(*rim.by_duration.value == Approx((2.0 / 7.0 + 3.0 / 5.0) / 2.0));
    CHECK(*rim.pooled == Approx(3.0 / 7.0));
    const auto wilson = wilson_interval(3.0, 7.0, study.options.confidence);
    CHECK(rim.pooled_interval->low == wilson->low);
    CHECK(rim.pooled_interval->high == wilson->high);
    REQUIRE(rim.of_observers.size() == 2);
    CHECK(rim.of_observers[0] == Approx(1.0 / 3.0));
    CHECK(rim.of_observers[1] == Approx(0.5));
    CHECK(rim.trials == 3);
    CHECK(rim.observers == 2);
    CHECK(rim.fixations == 7);
    CHECK(rim.looks == 3);
    CHECK(rim.arrivals == 2);
    CHECK(*rim.dwell_s.value == Approx((0.25 + 0.75) / 2.0));
    CHECK(*rim.visits.value == Approx((0.5 + 1.0) / 2.0));
    CHECK(*rim.visit_s.value == Approx((0.5 + 0.75) / 2.0));
    CHECK(*rim.reached.value == Approx((0.5 + 1.0) / 2.0));
    CHECK(*rim.first_arrival_s.value == Approx(((0.5 + 8.0) / 2.0 + 1.5) / 2.0));
    CHECK(*rim.first_arrival_number.value == Approx((1.0 + 3.0) / 2.0));
    // What is on no part, and what is not counted, is in no share.
    study.results.fixations[0].part.reset();
    study.results.fixations[3].why = NotCounted::too_short;
    CHECK(*study.row("rim").by_count.value == Approx((0.0 + 2.0 / 3.0) / 2.0));
    CHECK(study.row("rim").fixations == 5);
    CHECK(is_on_area(study.results, study.results.fixations[5], "rim") == std::optional(true));
    CHECK(is_on_area(study.results, study.results.fixations[1], "rim") == std::optional(false));
    CHECK_FALSE(is_on_area(study.results, study.results.fixations[0], "rim"));
    CHECK_FALSE(is_on_area(study.results, study.results.fixations[1], "spout"));
}

TEST_CASE("what even gaze would give is a mean over the objects that fixations are on", "[unit]") {
    LookedStudy study(2, {});
    study.add(0, {{1}, {1}, {0}}, 0); // three on the vase
    study.add(1, {{2}}, 1);           // one on the bowl
    name_areas(study.results, study.options);
    study.results.groups = make_groups(study.results, {}, {});
    ExposureRow vase, bowl, other;
    vase.area = bowl.area = "rim";
    other.area = "base";
    vase.share_of_area = 0.25;
    vase.share_of_exposure = 0.5;
    bowl.object = 1;
    bowl.share_of_area = 0.75;
    bowl.share_of_exposure = 0.125;
    other.share_of_area = other.share_of_exposure = 0.9;
    study.results.exposures = {other, vase, bowl};
    const AreaRow rim = study.row("rim");
    CHECK(*rim.share_of_surface == Approx((3 * 0.25 + 0.75) / 4.0));
    CHECK(*rim.share_of_exposure == Approx((3 * 0.5 + 0.125) / 4.0));
    CHECK(*rim.over_surface.value == Approx(*rim.by_count.value / *rim.share_of_surface));
    CHECK(*rim.over_exposure.value == Approx(*rim.by_count.value / *rim.share_of_exposure));
    study.results.exposures = {other, vase}; // that of the bowl is not known
    CHECK_FALSE(study.row("rim").share_of_surface);
}

TEST_CASE("the course of an area's share takes of each fixation what lies in each stretch of time",
          "[unit]") {
    LookedStudy study(2, {});
    study.add(0, {{1, 0.5}, {0, 0.25}}, 0); // rim 0.5 to 1.0 s, body 1.25 to 1.5 s
    study.add(0, {{3, 1.0}}, 0);            // base 0.5 to 1.5 s
    // Body 0.5 to 0.75 and 1.0 to 1.25 s, rim 1.5 to 2.0 s, its handle 2.25 to 2.5 s.
    study.add(1, {{0, 0.25}, {0, 0.25}, {1, 0.5}, {2, 0.25}}, 0);
    for (StudyTrial& trial : study.results.trials)
        trial.presentation_s = 2.9;
    name_areas(study.results, study.options);
    study.options.time_step_s = 0.4;
    auto rows = area_time_course(study.results, {}, study.options);
    std::erase_if(rows, [](const TimeCourseRow& row) { return row.area != "rim"; });
    REQUIRE(rows.size() == 8);
    const std::array<std::pair<int, double>, 8> expected{
        std::pair{0, 0.0}, {2, 0.25}, {2, 1.0 / 6.0}, {2, 1.0 / 3.0}, {1, 1.0}, {1, 1.0}, {1, 1.0}, {0, 0.0}};
    for (std::size_t i = 0; i < 8; ++i) {
        CAPTURE(i);
        CHECK(rows[i].from_s == Approx(0.4 * static_cast<double>(i)));
        CHECK(rows[i].to_s == Approx(i == 7 ? 2.9 : 0.4 * static_cast<double>(i + 1)));
        CHECK(rows[i].observers == expected[i].first);
        CHECK(rows[i].share.value.has_value() == (expected[i].first > 0));
        if (expected[i].first > 0)
            CHECK(*rows[i].share.value == Approx(expected[i].second).margin(1e-9));
    }
    // By the levels of the first column.
    for (StudyTrial& trial : study.results.trials)
        trial.keys.push_back({"material", trial.session == 0 ? "rough" : "smooth"});
    study.results.by = {"material"};
    rows = area_time_course(study.results, {}, study.options);
    CHECK(rows.size() == 4 * 2 * 8);
    const auto smooth = std::ranges::find_if(rows, [](const TimeCourseRow& row) {
        return row.area == "rim" && row.key.value == "smooth" && row.from_s > 1.1;
    });
    REQUIRE(smooth != rows.end());
    CHECK(*smooth->share.value == Approx(2.0 / 3.0));
}

TEST_CASE("rows of areas are of the groups, of each level and of all", "[unit]") {
    LookedStudy study(2, {});
    for (const int observer : {0, 1})
        for (const bool rough : {false, true})
            for (const bool lit : {false, true}) {
                study.add(observer, {{rough ? 1 : 0}, {lit ? 1 : 0}}, 0);
                study.results.trials.back().keys.push_back({"material", rough ? "rough" : "smooth"});
                study.results.trials.back().keys.push_back({"light", lit ? "day" : "dusk"});
            }
    study.options.by = study.results.by = {"material", "light"};
    name_areas(study.results, study.options);
    study.results.groups = make_groups(study.results, study.results.by, {});
    const auto rows = area_rows(study.results, {}, study.options);
    std::map<std::string, double> shares;
    for (const AreaRow& row : rows) {
        if (row.area != "rim")
            continue;
        std::string name;
        for (const StudyKey& key : row.keys)
            name += key.column + "=" + key.value + " ";
        CHECK(shares.emplace(name, *row.by_count.value).second);
    }
    CHECK(shares == std::map<std::string, double>{{"", 0.5},
                                                  {"material=rough ", 0.75},
                                                  {"material=smooth ", 0.25},
                                                  {"light=day ", 0.75},
                                                  {"light=dusk ", 0.25},
                                                  {"material=rough light=day ", 1.0},
                                                  {"material=rough light=dusk ", 0.5},
                                                  {"material=smooth light=day ", 0.5},
                                                  {"material=smooth light=dusk ", 0.0}});
    study.results.area_rows = rows;
    CHECK(rows_of_figure_area(study.results).size() == 9);
    CHECK(std::ranges::all_of(rows_of_figure_area(study.results),
                              [](const AreaRow& row) { return row.area == "rim"; }));
}

TEST_CASE("pairs of levels are corrected within an area, those of groups apart from those of all", "[unit]") {
    // Two objects that stand apart in "room"; three levels; to the rim go 3, 1 and 0 of four in one room, 2,
    // 1 and 1 in the other.
    LookedStudy study(8, {});
    const int on_rim[2][3] = {{3, 1, 0}, {2, 1, 1}};
    for (int observer = 0; observer < 8; ++observer)
        for (const int room : {0, 1})
            for (const int level : {0, 1, 2}) {
                std::vector<Looked> looks;
                for (int i = 0; i < 4; ++i)
                    looks.push_back({i < on_rim[room][level] ? 1 : 0});
                study.add(observer, looks, 0);
                study.results.trials.back().keys.push_back(
                    {"material", std::string(1, static_cast<char>('a' + level))});
                study.results.trials.back().keys.push_back({"room", room == 0 ? "one" : "two"});
            }
    study.options.by = study.results.by = {"room", "material"};
    study.options.areas = {"rim"};
    name_areas(study.results, study.options);
    std::vector<ObjectSurface> surfaces(2);
    surfaces[0].scale = ObjectScale{1.0, 1000.0, 30.0};
    const auto rows = area_pairs(study.results, surfaces, {}, study.options);
    REQUIRE(rows.size() == 9);
    const std::array<double, 9> differences{0.5, 0.75, 0.25, 0.25, 0.25, 0.0, 0.375, 0.5, 0.125};
    const std::array<const char*, 9> pairs{"ab", "ac", "bc", "ab", "ac", "bc", "ab", "ac", "bc"};
    for (std::size_t i = 0; i < 9; ++i) {
        CAPTURE(i);
        CHECK(rows[i].a + rows[i].b == pairs[i]);
        CHECK(rows[i].column == "material");
        CHECK(rows[i].keys.size() == (i < 6 ? 1u : 0u));
        if (i < 6)
            CHECK(rows[i].keys[0].value == (i < 3 ? "one" : "two"));
        CHECK(*rows[i].difference.value == Approx(differences[i]).margin(1e-12));
        CHECK(rows[i].observers == 8);
        CHECK(rows[i].comparisons == (i < 6 ? 8 : 16));
        // All observers alike: 2 of 256 signs, times five others that are as small, or two.
        if (differences[i] > 0.0) {
            CHECK(*rows[i].p == Approx(2.0 / 256.0));
            CHECK(*rows[i].p_holm == Approx((i < 6 ? 6 : 3) * 2.0 / 256.0));
            CHECK(*rows[i].p_holm_areas == *rows[i].p_holm);
        }
    }
}

TEST_CASE("transitions are those of each observer, by level, on objects with both areas", "[unit]") {
    LookedStudy study(2, {});
    study.add(0, {{1}, {3}, {3}, {0}}, 0);
    study.add(0, {{1}, {1}}, 1); // on the bowl, which has no base
    study.add(1, {{3}, {1}, {3}, {1}}, 0);
    for (StudyTrial& trial : study.results.trials)
        trial.keys.push_back({"material", trial.fixations == 2 ? "rough" : "smooth"});
    study.results.by = {"material"};
    name_areas(study.results, study.options);
    const auto rows = surface_transitions(study.results, {}, study.options);
    const auto row = [&](const std::string& level, const char* from, const char* to) {
        const auto found = std::ranges::find_if(rows, [&](const SurfaceTransitionRow& of) {
            return of.from == from && of.to == to &&
                   (level.empty() ? of.keys.empty() : !of.keys.empty() && of.keys[0].value == level);
        });
        REQUIRE(found != rows.end());
        return *found;
    };
    CHECK(rows.size() == 3 * 16);
    const SurfaceTransitionRow all = row("", "base", "base");
    CHECK(all.transitions == 1);
    CHECK(all.departures == 4); // two of either observer, those of the second to the rim
    CHECK(*all.probability.value == Approx((0.5 + 0.0) / 2.0));
    CHECK(*all.chance.value == Approx((2.0 / 3.0 + 1.0 / 3.0) / 2.0));
    CHECK(*all.over_chance.value == Approx(0.25 - 0.5));
    CHECK(all.observers == 2);
    CHECK(row("", "rim", "rim").departures == 3); // with that on the bowl
    CHECK(row("smooth", "rim", "rim").departures == 2);
    CHECK(row("rough", "rim", "rim").departures == 1);
    CHECK(row("rough", "rim", "rim").observers == 1);
    CHECK(transitions_between(study.results, 2, "rim", "base").to == 1);
    CHECK(transitions_between(study.results, 2, "rim", "base").departures == 1);
    CHECK(transitions_between(study.results, 2, "base", "rim").to == 2);
    CHECK(transitions_between(study.results, 1, "rim", "base").departures == 0);
}

TEST_CASE("transitions are from each counted fixation to the next, and stay beside what shares would give",
          "[unit]") {
    // To and fro between rim and base, with a gap that breaks one transition.
    LookedStudy study(3, {{{1}, {3}, {1}, {3}, {-1}, {1}, {3}}});
    const auto rows = surface_transitions(study.results, {}, study.options);
    CHECK(rows.size() == 16);
    const auto row = [&](const char* from, const char* to) {
        return *std::ranges::find_if(
            rows, [&](const SurfaceTransitionRow& of) { return of.from == from && of.to == to; });
    };
    CHECK(*row("rim", "base").probability.value == 1.0);
    CHECK(row("rim", "base").transitions == 9); // three of each of three observers
    CHECK(row("base", "rim").transitions == 3); // the gap took one
    CHECK(*row("rim", "base").chance.value == Approx(0.75));
    CHECK(*row("rim", "base").over_chance.value == Approx(0.25));
    CHECK(*row("rim", "rim").over_chance.value == Approx(-0.25));
    CHECK_FALSE(row("handle", "rim").probability.value);
    // A fixation in two areas departs from both.
    LookedStudy nested(3, {{{2}, {3}, {2}, {1}}});
    const auto of_nested = surface_transitions(nested.results, {}, nested.options);
    const auto probability = [&](const char* from, const char* to) {
        return *std::ranges::find_if(of_nested, [&](const SurfaceTransitionRow& of) {
                    return of.from == from && of.to == to;
                })->probability.value;
    };
    CHECK(probability("handle", "rim") == 0.5);
    CHECK(probability("rim", "rim") == 0.5);
    CHECK(probability("base", "handle") == 1.0);
}

TEST_CASE("levels are compared on each area, and corrected over all", "[unit]") {
    LookedStudy study(8, {});
    for (int observer = 0; observer < 8; ++observer) {
        for (const bool is_rough : {false, true}) {
            // Rough draws gaze to the base; to the rim gaze goes as often in both.
            study.add(observer,
                      is_rough ? std::vector<Looked>{{3}, {3}, {3}, {1}}
                               : std::vector<Looked>{{3}, {0}, {observer % 2 ? 0 : 2}, {1}},
                      0);
            study.results.trials.back().keys.push_back({"material", is_rough ? "rough" : "smooth"});
        }
    }
    study.options.by = study.results.by = {"material"};
    std::vector<ObjectSurface> surfaces(2);
    surfaces[0].scale = ObjectScale{1.0, 1000.0, 30.0};
    const auto rows = area_pairs(study.results, surfaces, {}, study.options);
    REQUIRE(rows.size() == 4);
    const auto row = [&](const char* area) { return *std::ranges::find(rows, area, &AreaPairRow::area); };
    CHECK(row("base").a == "rough");
    CHECK(*row("base").difference.value == Approx(0.5));
    CHECK(*row("base").p == Approx(2.0 / 256.0)); // all signs alike, of 2^8
    CHECK(*row("base").p_holm == *row("base").p);
    CHECK(*row("base").p_holm_areas == Approx(4.0 * 2.0 / 256.0).margin(1e-9));
    CHECK(*row("handle").difference.value == Approx(-0.125));
    CHECK(*row("handle").p_holm_areas >= *row("handle").p);
    study.options.areas = {"base"};
    name_areas(study.results, study.options);
    const auto alone = area_pairs(study.results, surfaces, {}, study.options);
    REQUIRE(alone.size() == 1);
    CHECK(*alone[0].p_holm_areas == *alone[0].p);
}
