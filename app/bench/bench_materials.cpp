#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "render/bake/further_laws.h"

namespace overt {

BenchFigures bench_materials(const BenchOptions&) {
    BenchFigures figures;
    std::vector<SurfaceLaw> laws = surface_laws();
    std::ranges::move(further_laws(), std::back_inserter(laws));
    for (const SurfaceLaw& law : laws)
        figures.push_back(
            {law.what, law.ours, "",
             fmt::format("{}{:.6g} +- {:.0e}", law.is_bound ? "at most " : "", law.known, law.tolerance),
             law.holds()});
    return figures;
}

} // namespace overt
