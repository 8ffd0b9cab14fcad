#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "render/bake/surface_laws.h"

namespace overt {

BenchFigures bench_materials(const BenchOptions&) {
    BenchFigures figures;
    for (const SurfaceLaw& law : surface_laws())
        figures.push_back(
            {law.what, law.ours, "",
             fmt::format("{}{:.6g} +- {:.0e}", law.is_bound ? "at most " : "", law.known, law.tolerance),
             law.holds()});
    return figures;
}

} // namespace overt
