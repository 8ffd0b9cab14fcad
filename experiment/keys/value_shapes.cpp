#include "experiment/keys/value_read.h"

#include <span>

namespace overt {

namespace {

/// The items of a list of lists; what is one such item itself, as its first element tells, counts as a list
/// of it: `[x, y, z, r]` as `[[x, y, z, r]]`. `depth`: of lists in an item.
std::span<const TomlValue> items_of(const TomlValue& value, int depth) {
    const TomlValue* first = &value;
    for (int level = 0; level < depth && first->list() && !first->list()->empty(); ++level)
        first = &first->list()->front();
    if (first->list())
        return *value.list();
    return {&value, 1};
}

} // namespace

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Triples& out) {
    if (!value.list())
        return wrong_kind<Triples>(value, rule);
    for (const TomlValue& item : items_of(value, 1)) {
        if (ValueResult fault = read_numbers<Triples>(item, rule, 3, out.emplace_back().data()))
            return fault;
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Spheres& out) {
    if (!value.list())
        return wrong_kind<Spheres>(value, rule);
    for (const TomlValue& item : items_of(value, 1)) {
        std::array<double, 4> sphere{};
        if (ValueResult fault = read_numbers<Spheres>(item, rule, sphere.size(), sphere.data()))
            return fault;
        if (!(sphere[3] > 0.0))
            return ValueFault{
                item.place, fmt::format("{}: a sphere's radius of {} is not above 0", rule.name, sphere[3])};
        out.push_back(sphere);
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Planes& out) {
    if (!value.list())
        return wrong_kind<Planes>(value, rule);
    for (const TomlValue& item : items_of(value, 2)) {
        const TomlList* pair = item.list();
        if (!pair || pair->size() != 2)
            return ValueFault{
                item.place,
                fmt::format("{}: expected a point and a direction, [[x, y, z], [nx, ny, nz]]", rule.name)};
        std::array<double, 6> plane{};
        for (std::size_t half = 0; half < 2; ++half) {
            if (ValueResult fault = read_numbers<Planes>((*pair)[half], rule, 3, plane.data() + 3 * half))
                return fault;
        }
        if (plane[3] == 0.0 && plane[4] == 0.0 && plane[5] == 0.0)
            return ValueFault{(*pair)[1].place,
                              fmt::format("{}: a direction of length 0 points nowhere", rule.name)};
        out.push_back(plane);
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Boxes& out) {
    if (!value.list())
        return wrong_kind<Boxes>(value, rule);
    for (const TomlValue& item : *value.list()) {
        const TomlList* pair = item.list();
        if (!pair || pair->size() != 2)
            return ValueFault{item.place,
                              fmt::format("{}: expected two corners, [[x, y, z], [x, y, z]]", rule.name)};
        auto& [low, high] = out.emplace_back();
        for (const auto& [corner, written] : {std::pair{&low, &(*pair)[0]}, {&high, &(*pair)[1]}}) {
            if (ValueResult fault = read_numbers<Boxes>(*written, rule, 3, &corner->x))
                return fault;
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (!(low[axis] < high[axis]))
                return ValueFault{item.place,
                                  fmt::format("{}: the box reaches from {} to {} along {}", rule.name,
                                              low[axis], high[axis], "xyz"[axis]),
                                  "give the corner with the smallest coordinates first"};
        }
    }
    return std::nullopt;
}

} // namespace overt
