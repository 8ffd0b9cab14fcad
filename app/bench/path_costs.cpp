#include "app/bench/path_costs.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/painted_look.h"
#include "render/bake/eye_rays.h"
#include "render/bake/frame_baker.h"
#include "render/bake/material_model.h"

namespace overt {

namespace {

struct CostCase {
    std::string name;
    MaterialSettings material;
};

std::vector<CostCase> cost_cases() {
    std::vector<CostCase> cases;
    for (const MaterialKindRow& row : material_kinds) {
        CostCase one{std::string(row.name), {}};
        one.material.kind = row.kind;
        one.material.metal = "Au";
        cases.push_back(std::move(one));
    }
    const auto add = [&](std::string name, MaterialKind kind, const auto& change) {
        CostCase one{std::move(name), {}};
        one.material.kind = kind;
        one.material.metal = "Au";
        change(one.material);
        cases.push_back(std::move(one));
    };
    add("glass, rough", MaterialKind::glass, [](MaterialSettings& m) { m.roughness = 0.3; });
    add("glass of many colours", MaterialKind::glass, [](MaterialSettings& m) { m.abbe = 36.0; });
    add("rough-conductor, brushed", MaterialKind::rough_conductor,
        [](MaterialSettings& m) { m.anisotropy = 0.6; });
    add("rough-conductor, all its light", MaterialKind::rough_conductor,
        [](MaterialSettings& m) { m.multiple_scattering = true; });
    return cases;
}

} // namespace

void measure_path_costs(BenchFigures& figures, const Object& object, const SpectralLight& light,
                        const SceneView& view) {
    constexpr int samples = 16, turns = 2;
    MaterialSettings polished;
    polished.kind = MaterialKind::smooth_conductor;
    polished.metal = "Au";
    const BakeScene mirror(object.mesh, polished);
    const auto seconds = [&](const BakeScene& scene) {
        const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {0.0});
        const double begin = processor_seconds();
        bake_frame(scene, light, view, {0.0}, covered, {.samples = samples});
        return processor_seconds() - begin;
    };
    const std::shared_ptr<const SurfaceAppearance> look = painted_look(object.mesh);
    for (const CostCase& one : cost_cases()) {
        const BakeScene scene(object.mesh, one.material, one.material.is_of_file() ? look : nullptr);
        double took = 0.0, by = 0.0;
        for (int turn = 0; turn < turns; ++turn) {
            by += seconds(mirror);
            took += seconds(scene);
        }
        const double counted = model_of(one.material).path_cost;
        figures.push_back({one.name + ", a path by one of polished metal", took / by, "",
                           fmt::format("{} is counted, within a factor of 2", counted),
                           std::abs(std::log2(took / by / counted)) <= 1.0});
    }
}

} // namespace overt
