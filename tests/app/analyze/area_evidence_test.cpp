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
    static constexpr double error_deg = 0.6;
    struct Found {
        std::vector<double> raw, corrected; ///< by observer
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
            int found; ///< 1: on the head, 0: elsewhere, -1: beside the bust
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
                    places.push_back({pose, place, error * px_per_deg});
                    const auto met =
                        targets_->surface_at(place, poses_.angles[static_cast<std::size_t>(pose.value)]);
                    fixations.push_back({observer, trial % 4, met ? met->part == head : -1});
                }
            }
        }
        const auto evidence =
            area_evidence(mesh_, Areas(mesh_.part_names), scene_.objects[0].scene, poses_.angles, places);
        std::array<Found, 4> found;
        for (int task = 0; task < 4; ++task) {
            for (int observer = 0; observer < observers; ++observer) {
                std::vector<AreaEvidence> own;
                double heads = 0.0, met = 0.0;
                for (std::size_t i = 0; i < fixations.size(); ++i) {
                    if (fixations[i].observer != observer || fixations[i].task != task)
                        continue;
                    if (!evidence[i].empty())
                        own.push_back(evidence[i][head_index]);
                    heads += fixations[i].found == 1;
                    met += fixations[i].found >= 0;
                }
                found[static_cast<std::size_t>(task)].raw.push_back(heads / met);
                found[static_cast<std::size_t>(task)].corrected.push_back(*most_probable_share(own));
            }
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

TEST_CASE("intervals of corrected head shares hold what was planted as often as they say", "[session]") {
    const PlantedStudies studies;
    int corrected = 0, raw = 0;
    for (int number = 0; number < 24; ++number) {
        const auto found = studies.study(number, 8, PlantedStudies::error_deg);
        for (std::size_t task = 0; task < 4; ++task) {
            const double planted = PlantedStudies::planted[task];
            corrected += bootstrap_interval_of_mean(found[task].corrected, {})->contains(planted);
            raw += bootstrap_interval_of_mean(found[task].raw, {})->contains(planted);
        }
    }
    // Of 96 intervals at 95 %, 82 or fewer hold the truth once in 3,307 times: the binomial distribution, by
    // Python's math.comb.
    INFO(corrected << " corrected and " << raw << " raw intervals of 96");
    CHECK(corrected >= 83);
    CHECK(raw < 83);
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
