/// Maps by sample of a surface against the same maps at every node of its mesh.
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/study/map_predictions.h"
#include "experiment/study/study_maps.h"
#include "tests/experiment/study/painted_study.h"
#include "tests/experiment/surface/flat_and_round.h"

using namespace overt;

namespace {

/// Two sheets of 120 x 120 mm with as many nodes each: the front one, which is looked at, is flat, and the
/// back one so rough that whoever leaves out nodes by how little the shape changes keeps hardly any in front.
Mesh slab(int n) {
    Mesh mesh = test::flat_square(60.0, n, 10.0);
    const Mesh back = test::flat_square(60.0, n, -10.0);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    RandomStream random(1, "rough back");
    for (glm::vec3 position : back.positions) {
        position.z += static_cast<float>(1.5 * random.normal());
        mesh.positions.push_back(position);
    }
    for (const glm::uvec3& t : back.triangles)
        mesh.triangles.emplace_back(first + t.x, first + t.z, first + t.y);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    return mesh;
}

/// Observers who look at two overlapping spots of the slab's front, one for each level.
struct SlabStudy {
    static constexpr int squares = 70, observers = 5, fixations = 12;

    SlabStudy(double sigma_mm, double apart_mm) {
        auto mesh = std::make_shared<Mesh>(slab(squares));
        StudyObject& object = results.objects.emplace_back();
        object.id = "slab";
        object.mm_per_unit = 1.0;
        ObjectSurface& surface = surfaces.emplace_back();
        surface.geometry = std::make_unique<SurfaceGeometry>(*mesh);
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
        surface.scale = ObjectScale{1.0, 1000.0, sigma_mm};
        double exposed = 0.0;
        for (std::size_t v = 0; v < mesh->positions.size(); ++v) {
            const bool is_front = mesh->positions[v].z == 10.0f;
            object.seconds_visible.push_back(is_front ? 8.0f : 0.0f);
            // Seen from one side: more on the left.
            object.exposure_density.push_back(is_front ? 1.5f - mesh->positions[v].x / 120.0f : 0.0f);
            exposed += surface.areas_mm2[v] * static_cast<double>(object.exposure_density.back());
        }
        for (float& density : object.exposure_density)
            density /= static_cast<float>(exposed);
        if (HatSmoother::is_worth_while(*surface.geometry, sigma_mm))
            surface.hats = std::make_unique<HatSmoother>(*surface.geometry, sigma_mm, sigma_mm);
        for (int observer = 0; observer < observers; ++observer) {
            results.sessions.emplace_back().observer = std::string(1, static_cast<char>('a' + observer));
            for (const char* level : {"clay", "gold"}) {
                RandomStream random(3, level, static_cast<std::uint64_t>(observer));
                StudyTrial trial;
                trial.session = observer;
                trial.keys = {{"observer", results.sessions.back().observer}, {"material", level}};
                trial.first_fixation = results.fixations.size();
                trial.fixations = fixations;
                for (int i = 0; i < fixations; ++i)
                    look_at({(level[0] == 'c' ? -0.5 : 0.5) * apart_mm + 13.0 * random.normal(),
                             13.0 * random.normal()},
                            sigma_mm, *mesh);
                results.trials.push_back(std::move(trial));
            }
        }
        object.mesh = mesh;
        results.by = options.by = {"material"};
        results.groups = make_groups(results, options.by, {});
        options.resamples = 50;
    }

    Fixations of(std::size_t level, int but_observer = -1) const {
        Fixations found;
        for (std::size_t trial = level; trial < results.trials.size(); trial += 2) {
            if (results.trials[trial].session == but_observer)
                continue;
            const Fixations own = of_trial(trial);
            found.insert(found.end(), own.begin(), own.end());
        }
        return found;
    }
    Fixations of_trial(std::size_t trial) const {
        return fixations_on(results, std::array{static_cast<int>(trial)}, 0);
    }

    StudyResults results;
    std::vector<ObjectSurface> surfaces;
    StudyOptions options;

  private:
    void look_at(glm::dvec2 at, double sigma_mm, const Mesh& mesh) {
        // In the upper left or the lower right triangle of a square.
        at = glm::clamp(at, -59.0, 59.0);
        const glm::dvec2 in_squares = (at + 60.0) / 120.0 * static_cast<double>(squares);
        const auto column = static_cast<std::uint32_t>(in_squares.x),
                   row = static_cast<std::uint32_t>(in_squares.y);
        const double u = in_squares.x - column, v = in_squares.y - row;
        const std::uint32_t square = 2 * (row * squares + column);
        StudyFixation& fixation = results.fixations.emplace_back();
        fixation.trial = static_cast<int>(results.trials.size());
        fixation.duration_s = 0.25;
        fixation.triangle = u > v ? square : square + 1;
        fixation.barycentric = u > v ? glm::dvec3(1.0 - u, u - v, v) : glm::dvec3(1.0 - v, u, v - u);
        fixation.position = glm::dvec3(0.0);
        for (int corner = 0; corner < 3; ++corner)
            fixation.position += fixation.barycentric[corner] *
                                 glm::dvec3(mesh.positions[mesh.triangles[*fixation.triangle][corner]]);
        REQUIRE(glm::distance(fixation.position, glm::dvec3(at, 10.0)) < 1e-4);
        fixation.sigma_mm = fixation.mm_per_deg = sigma_mm;
    }
};

/// The same with the densities of all nodes of the mesh and their areas.
struct AllNodes {
    explicit AllNodes(const SlabStudy& study, double sigma_mm)
        : study_(study), smoother_(*study.surfaces[0].geometry, sigma_mm) {
        const StudyObject& slab = study.results.objects[0];
        visible = study.surfaces[0].areas_mm2;
        for (std::size_t v = 0; v < visible.size(); ++v) {
            if (!(slab.seconds_visible[v] > 0.0f))
                visible[v] = 0.0;
            exposure.push_back(static_cast<double>(slab.exposure_density[v]));
        }
    }
    std::vector<double> sum_of(const Fixations& fixations) const {
        std::vector<SurfaceWeight> weights;
        for (const StudyFixation* fixation : fixations)
            weights.push_back(weight_of(*fixation, 1.0));
        return smoother_.density(weights);
    }
    std::vector<double> at(const std::vector<double>& map, const Fixations& there) const {
        std::vector<double> found;
        for (const StudyFixation* place : there) {
            double value = 0.0;
            for (int corner = 0; corner < 3; ++corner)
                value += place->barycentric[corner] *
                         map[study_.surfaces[0].geometry->corners(*place->triangle)[corner]];
            found.push_back(value);
        }
        return found;
    }
    /// Over the exposure, in bits, of a level's observers by the others'.
    double gain(std::size_t level) const {
        double sum = 0.0;
        for (int observer = 0; observer < SlabStudy::observers; ++observer) {
            const Fixations others = study_.of(level, observer),
                            own = study_.of_trial(2 * static_cast<std::size_t>(observer) + level);
            std::vector<double> map = sum_of(others);
            for (std::size_t v = 0; v < map.size(); ++v)
                map[v] = (map[v] + exposure[v]) / static_cast<double>(others.size() + 1);
            sum += *information_gain(map, exposure, visible, at(map, own), at(exposure, own));
        }
        return sum / SlabStudy::observers;
    }

    std::vector<double> visible, exposure;

  private:
    const SlabStudy& study_;
    SurfaceSmoother smoother_;
};

} // namespace

TEST_CASE("metrics over samples of a surface are those over all of its nodes, on flat faces too", "[unit]") {
    // With hats for the heat and without them; levels that are alike, and levels that are not.
    for (const auto& [sigma_mm, apart_mm] : {std::pair(17.0, 12.0), {8.0, 50.0}}) {
        CAPTURE(sigma_mm, apart_mm);
        const SlabStudy study(sigma_mm, apart_mm);
        REQUIRE((study.surfaces[0].hats != nullptr) == (sigma_mm > 10.0));
        ObjectFixationMaps of_objects;
        of_objects.push_back(std::make_unique<FixationMaps>(study.results, 0, study.surfaces[0]));
        const FixationMaps& maps = *of_objects.front();
        const AllNodes all(study, sigma_mm);
        CHECK(maps.samples().count() < all.visible.size() / 2);
        // In front: across the rough back, ways along the surface are no more than nearly right.
        double farthest_mm = 0.0;
        for (std::uint32_t node = 0; node < maps.geometry().node_count(); ++node) {
            if (all.visible[node] > 0.0)
                farthest_mm =
                    std::max(farthest_mm, glm::distance(maps.geometry().node_positions_mm()[node],
                                                        maps.position_mm(maps.samples().nearest(node))));
        }
        CHECK(farthest_mm <= sigma_mm / 3.0 + 1e-6);
        CHECK(
            *correlation(maps.sum_of(study.of(0)), maps.sum_of(study.of(1)), maps.visible_areas()) ==
            Approx(*correlation(all.sum_of(study.of(0)), all.sum_of(study.of(1)), all.visible)).margin(0.01));
        for (const MapPredictionRow& row : map_predictions(study.results, of_objects, study.options)) {
            if (row.by == MapPredictor::same_level)
                CHECK(*row.gain_over_exposure.value ==
                      Approx(all.gain(static_cast<std::size_t>(row.group))).margin(0.01));
        }
    }
}

TEST_CASE("what is on a fixation's own place is in the sum of maps there, and no more than all of it",
          "[unit]") {
    const SlabStudy study(17.0, 20.0);
    const FixationMaps maps(study.results, 0, study.surfaces[0]);
    const AllNodes all(study, 17.0);
    const Fixations clay = study.of(0), gold = study.of(1);
    const std::vector<double> found = maps.sum_at(clay, gold), expected = all.at(all.sum_of(clay), gold);
    const double most = *std::max_element(expected.begin(), expected.end());
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i] == Approx(expected[i]).margin(0.015 * most));
    // Each has the mass of one fixation, visible or not.
    CHECK(integral(maps.sum_of(clay), maps.areas()) ==
          Approx(static_cast<double>(clay.size())).epsilon(1e-3));
    const double visible = std::accumulate(maps.visible_areas().begin(), maps.visible_areas().end(), 0.0);
    CHECK(visible == Approx(120.0 * 120.0).epsilon(1e-6));
}

TEST_CASE("where nobody knows what is shown there is no exposure, and where they do its integral is 1",
          "[unit]") {
    test::PaintedStudy study(2, 1, 3, [](int, int, RandomStream&) { return test::front; });
    for (float& density : study.results.objects[0].exposure_density)
        density = 7.0f;
    const auto maps = fixation_maps(study.results, study.surfaces);
    CHECK(integral(maps[0]->exposure(), maps[0]->visible_areas()) == Approx(1.0));
    study.results.objects[0].exposure_density.clear();
    CHECK(fixation_maps(study.results, study.surfaces)[0]->exposure().empty());
}
