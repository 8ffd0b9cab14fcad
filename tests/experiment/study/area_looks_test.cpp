/// What is reckoned of areas, by hand.
#include "experiment/study/area_looks.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
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
