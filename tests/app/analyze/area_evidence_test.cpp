/// What is found of planted head shares after a tracker's error, without drawing anything.
#include "experiment/study/read/area_evidence.h"

#include <cmath>
#include <memory>

#include <catch2/catch.hpp>

#include "devices/simulated/gaze_plan.h"
#include "devices/simulated/gaze_script.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/statistics/bootstrap.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

/// The paper's four tasks about one bust, whose head is 4.1 errors of the tracker wide.
class PlantedStudies {
  public:
    static constexpr std::array<double, 4> planted{0.613, 0.400, 0.155, 0.202};
    struct Found {
        std::vector<double> meant, raw, corrected; ///< by observer
    };

    PlantedStudies() {
        const View view{fit_camera(mesh_, {11.9}, {1024, 1024}, {25.0}, 0.06), {1024, 1024}};
        scene_.objects = {{&mesh_, SceneView{view, mesh_.bounds()}}};
        scene_.animations[0].frame_count = 31;
        for (const double share : planted)
            scene_.tasks.push_back({"", {share}});
        poses_ = distinct_poses(scene_.animations[0]);
        targets_ = std::make_unique<GazeTargets>(scene_.objects[0], scene_);
        turn_ = std::make_unique<PursuedTurn>(scene_);
    }

    /// A study of new observers: four trials of each task, with the tracker's error constant in each.
    std::array<Found, 4> study(int number, int observers, double error) const {
        const glm::dvec2 px_per_deg = px_per_deg_at_centre(scene_.screen);
        struct Fixation {
            int observer, task;
            int found;     ///< 1: on the head, 0: elsewhere, -1: beside the bust
            bool is_meant; ///< for the head
        };
        std::vector<Fixation> fixations;
        std::vector<MeasuredPlace> places;
        GazeScript script(scene_, {});
        for (int observer = 0; observer < observers; ++observer) {
            const auto seed = static_cast<std::uint64_t>(100 * number + observer);
            for (int trial = 0; trial < 16; ++trial) {
                script.compose(scene_, targets_.get(), *turn_, {}, seed, trial,
                               gaze_plan(scene_, seed, trial % 4, {0, 0}));
                RandomStream random(seed, "error of a trial", static_cast<std::uint64_t>(trial));
                const glm::dvec2 off = error * glm::dvec2(random.normal(), random.normal());
                for (std::size_t i = 1; i < script.fixations().size(); ++i) {
                    const ScriptedFixation& of = script.fixations()[i];
                    if (!of.target || to_seconds(of.begin) >= scene_.animations[0].duration_s)
                        continue;
                    const SessionDuration middle = (of.begin + of.end) / 2 - of.light_delay;
                    const PoseIndex pose =
                        poses_.pose_of(0, scene_.animations[0].frame_at_step(turn_->step_at(middle)));
                    const glm::dvec2 place =
                        targets_->project(of.target->position,
                                          targets_->world_from_object(turn_->angle_at(middle))) +
                        off * px_per_deg;
                    places.push_back({pose, place, error * px_per_deg, observer * 16 + trial});
                    const auto met =
                        targets_->surface_at(place, poses_.angles[static_cast<std::size_t>(pose.value)]);
                    fixations.push_back(
                        {observer, trial % 4, met ? met->part == head : -1, of.target->part == head});
                }
            }
        }
        const auto evidence =
            area_evidence(mesh_, Areas(mesh_.part_names), scene_.objects[0].scene, poses_.angles, places);
        std::array<Found, 4> found;
        for (int task = 0; task < 4; ++task) {
            std::vector<std::vector<AreaEvidence>> all;
            Found& of_task = found[static_cast<std::size_t>(task)];
            for (int observer = 0; observer < observers; ++observer) {
                std::vector<AreaEvidence>& own = all.emplace_back();
                double heads = 0.0, met = 0.0, meant = 0.0, count = 0.0;
                for (std::size_t i = 0; i < fixations.size(); ++i) {
                    if (fixations[i].observer != observer || fixations[i].task != task)
                        continue;
                    if (!evidence[i].empty())
                        own.push_back(evidence[i][head_index]);
                    heads += fixations[i].found == 1;
                    met += fixations[i].found >= 0;
                    meant += fixations[i].is_meant;
                    ++count;
                }
                of_task.raw.push_back(heads / met);
                of_task.meant.push_back(meant / count);
            }
            of_task.corrected = shares_of_observers(all);
        }
        return found;
    }

    const Mesh& mesh() const { return mesh_; }
    const SceneView& view() const { return scene_.objects[0].scene; }
    const PoseTable& poses() const { return poses_; }
    static constexpr PartIndex head = 1;
    static constexpr std::size_t head_index = 1; ///< of the areas

  private:
    Mesh mesh_ = test::bust();
    ObservedScene scene_;
    PoseTable poses_;
    std::unique_ptr<GazeTargets> targets_;
    std::unique_ptr<PursuedTurn> turn_;
};

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

} // namespace

TEST_CASE("corrected head shares are those that were meant, whatever the error that trials share",
          "[session]") {
    const PlantedStudies studies;
    const double error_deg = GENERATE(0.3, 0.6, 1.0);
    constexpr int count = 4;
    int corrected = 0;
    std::array<double, 4> bias{}, raw_bias{};
    for (int number = 0; number < count; ++number) {
        const auto found = studies.study(number, 8, error_deg);
        for (std::size_t task = 0; task < 4; ++task) {
            corrected += interval_of_mean(found[task].corrected, {})->contains(PlantedStudies::planted[task]);
            bias[task] += (mean(found[task].corrected) - mean(found[task].meant)) / count;
            raw_bias[task] += (mean(found[task].raw) - mean(found[task].meant)) / count;
        }
    }
    CAPTURE(error_deg, corrected, bias, raw_bias);
    // Of 16 intervals at 95 %, 12 or fewer hold the truth once in 144 times (binomial distribution).
    CHECK(corrected >= 12);
    // In 30 studies no bias was larger than BIAS; with errors taken for independent they were 0.057 at 1 deg.
    for (const double one : bias)
        CHECK(std::abs(one) < 0.02);
    CHECK(raw_bias[0] < -0.02);
}

TEST_CASE("shares of observers have no bias where single fixations tell little", "[unit]") {
    // Fixations of which the area is four times as probable as all else, or four times less: on the area 4 of
    // 5 are of the first kind, elsewhere 1 of 5. Of ten fixations each.
    RandomStream random(3, "shares of observers", 0);
    const auto study = [&](double share) {
        std::vector<std::vector<AreaEvidence>> observers(400);
        for (std::vector<AreaEvidence>& own : observers) {
            for (int i = 0; i < 10; ++i) {
                const bool is_inside = random.uniform() < share;
                const bool looks_inside = random.uniform() < (is_inside ? 0.8 : 0.2);
                own.push_back(looks_inside ? AreaEvidence{0.8, 0.2} : AreaEvidence{0.2, 0.8});
            }
        }
        return observers;
    };
    for (const double share : {0.1, 0.5, 0.8}) {
        const auto observers = study(share);
        CHECK(mean(shares_of_observers(observers)) == Approx(share).margin(0.03));
        if (share == 0.1) {
            std::vector<double> apart;
            for (const std::vector<AreaEvidence>& own : observers)
                apart.push_back(*most_probable_share(own));
            CHECK(mean(apart) > share + 0.04); // they end at 0
        }
    }
    CHECK(shares_of_observers({}).empty());
    // Where all look on the area, or nobody does, shares are 1 and 0, and nothing beyond.
    const std::vector<AreaEvidence> inside(12, {0.9, 0.02}), outside(12, {0.01, 0.8});
    CHECK(shares_of_observers(std::vector{inside, inside}) == std::vector{1.0, 1.0});
    CHECK(shares_of_observers(std::vector{outside, outside, outside}) == std::vector{0.0, 0.0, 0.0});
    // Who has nothing that tells has no share.
    const std::vector<std::vector<AreaEvidence>> two{{{2.0, 1.0}, {1.0, 2.0}}, {{0.0, 0.0}}};
    CHECK(shares_of_observers(two).size() == 1);
    CHECK(shares_of_observers(two).front() == Approx(0.5));
}

TEST_CASE("the errors that a trial may have are as wide as the tracker's, with the rest", "[unit]") {
    double sum = 0.0;
    glm::dvec2 mean_error(0.0), squares(0.0);
    for (const TrialError& error : trial_errors()) {
        sum += error.probability;
        mean_error += error.probability * error.sigmas;
        squares += error.probability * error.sigmas * error.sigmas;
    }
    CHECK(sum == Approx(1.0));
    CHECK(glm::length(mean_error) == Approx(0.0).margin(1e-12));
    for (const int axis : {0, 1})
        CHECK(squares[axis] + trial_error_rest * trial_error_rest == Approx(1.0));
}

TEST_CASE("without an error of the tracker the correction changes nothing", "[unit]") {
    const auto found = PlantedStudies().study(7, 2, 0.02);
    for (const PlantedStudies::Found& task : found)
        CHECK(mean(task.corrected) == Approx(mean(task.raw)).margin(0.01));
}

TEST_CASE("the most probable share is that of the likelihood's peak", "[unit]") {
    CHECK_FALSE(most_probable_share({}));
    const std::vector<AreaEvidence> heads{{2.0, 0.0}, {1.0, 0.0}}, others{{0.0, 1.0}};
    CHECK(most_probable_share(heads) == 1.0);
    CHECK(most_probable_share(others) == 0.0);
    // Of counts without doubt it is their share; what says nothing of the part changes nothing.
    std::vector<AreaEvidence> mixed{{1.0, 0.0}, {3.0, 0.0}, {0.0, 5.0}, {0.0, 1.0}, {0.0, 2.0}};
    CHECK(*most_probable_share(mixed) == Approx(0.4));
    mixed.push_back({0.7, 0.7});
    CHECK(*most_probable_share(mixed) == Approx(0.4));
    // 1 / (1 + p) = 1 / (2 - p) for p in the middle; with weights 2 and 1 by hand: 2 (2 - p) = 1 + p.
    const std::vector<AreaEvidence> doubt{{2.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}};
    CHECK(*most_probable_share(doubt) == Approx(1.0));
    const std::vector<AreaEvidence> even{{2.0, 1.0}, {1.0, 2.0}};
    CHECK(*most_probable_share(even) == Approx(0.5));
}

TEST_CASE("fixations far from the object, too few of them and objects of one part have no evidence",
          "[unit]") {
    const PlantedStudies studies;
    const SightLines lines(studies.view(), studies.poses().angles[0]);
    const glm::dvec2 head(lines.project({0.0, -62.0, 245.0})), body(lines.project({0.0, -45.0, 120.0}));
    std::vector<MeasuredPlace> places;
    for (int i = 0; i < 30; ++i)
        places.push_back({{0}, i % 3 == 0 ? head : body, {10.0, 10.0}});
    places.push_back({{0}, {5.0, 5.0}, {10.0, 10.0}});
    const auto angles = studies.poses().angles;
    const Areas areas(studies.mesh().part_names);
    const auto evidence = area_evidence(studies.mesh(), areas, studies.view(), angles, places);
    REQUIRE(evidence.size() == 31);
    const auto of_head = [&](std::size_t i) { return evidence[i].at(PlantedStudies::head_index); };
    CHECK(of_head(0).inside > 1e3 * of_head(0).elsewhere);
    CHECK(of_head(1).elsewhere > 1e3 * of_head(1).inside);
    CHECK(evidence[30].empty());
    const auto few =
        area_evidence(studies.mesh(), areas, studies.view(), angles, std::span(places).first(19));
    CHECK(few.size() == 19);
    CHECK(few[0].empty());
    const std::vector<std::string> whole(3, "all of it");
    CHECK(area_evidence(studies.mesh(), Areas(whole), studies.view(), angles, places)[0].empty());
    CHECK(area_evidence(studies.mesh(), Areas(), studies.view(), angles, places)[0].empty());
}
