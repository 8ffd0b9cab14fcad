#include "render/bake/material_model.h"

#include <utility>

namespace overt {

const MaterialModel& model_of(MaterialKind kind) {
    using Model = const MaterialModel& (*)();
    constexpr auto models = []<std::size_t... i>(std::index_sequence<i...>) {
        return std::array<Model, sizeof...(i)>{&material_model<material_kinds[i].kind>...};
    }
    (std::make_index_sequence<material_kinds.size()>());
    return models[static_cast<std::size_t>(kind)]();
}

} // namespace overt
