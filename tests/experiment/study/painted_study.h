/// A study on a ball whose fixations are placed by hand: what is reckoned from fixations alone.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"
#include "tests/experiment/surface/flat_and_round.h"

namespace overt::test {

inline const glm::dvec3 front{0.0, -1.0, 0.0}, back{0.0, 1.0, 0.0}, top{0.0, 0.0, 1.0};

/// A ball of 100 mm, all of which is visible and exposed alike unless a test says otherwise. Observers look
/// in each level of "material" once, or in some trials.
class PaintedStudy {
  public:
    /// `look(observer, level, random)`: where a fixation is aimed, a direction from the ball's centre.
    using Look = std::function<glm::dvec3(int observer, int level, RandomStream& random)>;

    PaintedStudy(int observers, int levels, int fixations, const Look& look, std::uint64_t seed = 1,
                 const std::string& second_level = "rough", int trials = 1) {
        auto mesh = std::make_shared<Mesh>(icosphere(100.0, 3));
        mesh->part_names = {"body", "head"};
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
            mesh->triangle_parts[t] = mesh->positions[mesh->triangles[t].x].z > 70.0f ? 1 : 0;
        StudyObject ball;
        ball.id = "ball";
        ball.part_names = mesh->part_names;
        ball.areas = Areas(ball.part_names);
        ball.mm_per_unit = 1.0;
        ball.seconds_visible.assign(mesh->positions.size(), 8.0f);
        ball.exposure_density.assign(mesh->positions.size(), 1.0f);
        ball.mesh = mesh;
        results.objects.push_back(std::move(ball));
        results.areas = results.compared_areas = {"body", "head"};
        results.area = "head";
        results.by = options.by = {"material"};
        options.resamples = 200;
        ObjectSurface& surface = surfaces.emplace_back();
        surface.geometry = std::make_unique<SurfaceGeometry>(*mesh);
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
        surface.scale = ObjectScale{1.0, 1000.0, 30.0};
        for (int observer = 0; observer < observers; ++observer) {
            results.sessions.emplace_back().observer = fmt::format("{:02}", observer);
            for (int number = 0; number < trials * levels; ++number) {
                const int level = number / trials;
                StudyTrial trial;
                trial.session = observer;
                const std::string name = level == 0 ? "smooth" : level == 1 ? second_level : "matt";
                trial.keys = {{"observer", fmt::format("{:02}", observer)}, {"material", name}};
                trial.presentation_s = 8.0;
                trial.first_fixation = results.fixations.size();
                trial.fixations = static_cast<std::size_t>(fixations);
                RandomStream random(seed, "painted study",
                                    static_cast<std::uint64_t>(100 * observer + number));
                for (int i = 0; i < fixations; ++i)
                    add_fixation(*mesh, look(observer, level, random));
                results.trials.push_back(std::move(trial));
            }
        }
        results.groups = make_groups(results, options.by, {});
    }

    StudyResults results;
    std::vector<ObjectSurface> surfaces;
    StudyOptions options;

  private:
    void add_fixation(const Mesh& mesh, const glm::dvec3& towards) {
        std::uint32_t nearest = 0;
        double most = -1e9;
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            const double along = glm::dot(glm::dvec3(mesh.positions[v]), towards);
            if (along > most) {
                most = along;
                nearest = v;
            }
        }
        const SurfacePlace place = place_of_vertex(mesh, nearest);
        StudyFixation& fixation = results.fixations.emplace_back();
        fixation.trial = static_cast<int>(results.trials.size());
        fixation.duration_s = 0.25;
        fixation.triangle = place.triangle;
        fixation.barycentric = place.barycentric;
        fixation.position = mesh.positions[nearest];
        fixation.part = mesh.triangle_parts[place.triangle];
        fixation.sigma_mm = 30.0;
        fixation.mm_per_deg = 30.0;
    }
};

/// A direction normally distributed about another.
inline glm::dvec3 near(const glm::dvec3& direction, double spread, RandomStream& random) {
    return direction + spread * glm::dvec3(random.normal(), random.normal(), random.normal());
}

} // namespace overt::test
