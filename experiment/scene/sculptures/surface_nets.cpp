#include "experiment/scene/sculptures/surface_nets.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace overt {

namespace {

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). Edge e runs along axis e / 4 from the corner that
/// has the bits of e % 4 on the other two axes, in cyclic order.
struct CellEdge {
    int axis, from, to;
};

glm::ivec3 corner_offset(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2}; }

CellEdge cell_edge(int edge) {
    const int axis = edge / 4;
    const int from = (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
    return {axis, from, from | 1 << axis};
}

/// The edge of a cell along `axis` with the given offsets on the two following axes.
int edge_number(int axis, int first_offset, int second_offset) {
    return axis * 4 + first_offset + 2 * second_offset;
}

/// For a pattern of inside corners: the sheet that each cut edge belongs to, -1 for edges that are not cut.
struct CellSheets {
    std::array<std::int8_t, 12> sheet_of_edge;
    int sheets = 0;
};

int edge_between(int a, int b) {
    for (int e = 0; e < 12; ++e)
        if (const CellEdge edge = cell_edge(e);
            (edge.from == a && edge.to == b) || (edge.from == b && edge.to == a))
            return e;
    return -1;
}

/// On each face the curves of the surface go round the inside corners or pass between the two halves; edges
/// that a curve connects are of the same sheet.
CellSheets sheets_of(int pattern) {
    std::array<int, 12> group;
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](int e) {
        while (group[std::size_t(e)] != e)
            e = group[std::size_t(e)];
        return e;
    };
    const auto is_inside = [&](int corner) { return (pattern >> corner & 1) != 0; };
    for (int face = 0; face < 6; ++face) {
        const int u = 1 << (face / 2 + 1) % 3;
        const int v = 1 << (face / 2 + 2) % 3;
        const int base = (face & 1) << face / 2;
        const std::array<int, 4> ring{base, base | u, base | u | v, base | v};
        std::vector<int> cut;
        for (std::size_t i = 0; i < 4; ++i)
            if (is_inside(ring[i]) != is_inside(ring[(i + 1) % 4]))
                cut.push_back(edge_between(ring[i], ring[(i + 1) % 4]));
        if (cut.size() == 2)
            group[std::size_t(root(cut[0]))] = root(cut[1]);
        if (cut.size() == 4)
            for (std::size_t i = 0; i < 4; ++i)
                if (is_inside(ring[i]))
                    group[std::size_t(root(edge_between(ring[(i + 3) % 4], ring[i])))] =
                        root(edge_between(ring[i], ring[(i + 1) % 4]));
    }
    CellSheets result;
    result.sheet_of_edge.fill(-1);
    std::array<int, 12> number;
    number.fill(-1);
    for (int e = 0; e < 12; ++e)
        if (const CellEdge edge = cell_edge(e); is_inside(edge.from) != is_inside(edge.to)) {
            int& sheet = number[std::size_t(root(e))];
            if (sheet < 0)
                sheet = result.sheets++;
            result.sheet_of_edge[std::size_t(e)] = static_cast<std::int8_t>(sheet);
        }
    return result;
}

const std::array<CellSheets, 256>& sheet_table() {
    static const auto table = [] {
        std::array<CellSheets, 256> all;
        for (int pattern = 0; pattern < 256; ++pattern)
            all[std::size_t(pattern)] = sheets_of(pattern);
        return all;
    }();
    return table;
}

/// The four cells about an edge of the grid, counter-clockwise seen from the edge's end: how far each lies
/// back from the edge's start along the two other axes.
constexpr std::array<std::array<int, 2>, 4> cells_about_edge{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

class NetBuilder {
  public:
    explicit NetBuilder(const StretchedGrid& grid)
        : grid_(grid), first_vertex_(grid.index(grid.size() - 1) + 1, 0) {}

    PolygonNet build() {
        for_each_node([&](const glm::ivec3& cell) { add_vertices(cell); });
        for_each_node([&](const glm::ivec3& node) {
            for (int axis = 0; axis < 3; ++axis)
                add_polygon(node, axis);
        });
        return std::move(net_);
    }

  private:
    template <class Visit> void for_each_node(const Visit& visit) const {
        const glm::ivec3 size = grid_.size();
        for (int z = 0; z + 1 < size.z; ++z)
            for (int y = 0; y + 1 < size.y; ++y)
                for (int x = 0; x + 1 < size.x; ++x)
                    visit(glm::ivec3(x, y, z));
    }

    int pattern(const glm::ivec3& cell) const {
        int bits = 0;
        for (int corner = 0; corner < 8; ++corner)
            bits |= int(grid_.is_inside(cell + corner_offset(corner))) << corner;
        return bits;
    }

    /// Where the surface cuts the line between two neighbouring nodes, in nodes.
    glm::dvec3 cut(const glm::ivec3& from, const glm::ivec3& to) const {
        const double a = grid_.distance(from);
        const double b = grid_.distance(to);
        return glm::mix(glm::dvec3(from), glm::dvec3(to), a / (a - b));
    }

    /// Each sheet's vertex starts in the middle of its cuts with the cell's edges.
    void add_vertices(const glm::ivec3& cell) {
        const int bits = pattern(cell);
        if (bits == 0 || bits == 255)
            return;
        const CellSheets& sheets = sheet_table()[std::size_t(bits)];
        first_vertex_[grid_.index(cell)] = static_cast<std::uint32_t>(net_.positions.size());
        for (int sheet = 0; sheet < sheets.sheets; ++sheet) {
            glm::dvec3 sum(0.0);
            int cuts = 0;
            for (int e = 0; e < 12; ++e)
                if (sheets.sheet_of_edge[std::size_t(e)] == sheet) {
                    const CellEdge edge = cell_edge(e);
                    sum += cut(cell + corner_offset(edge.from), cell + corner_offset(edge.to));
                    ++cuts;
                }
            net_.positions.push_back(grid_.place(sum / double(cuts)));
        }
    }

    int sheet(const glm::ivec3& cell, int edge) const {
        return sheet_table()[std::size_t(pattern(cell))].sheet_of_edge[std::size_t(edge)];
    }

    /// The polygon around the edge from `node` along `axis`, through the cells about it.
    void add_polygon(const glm::ivec3& node, int axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        glm::ivec3 end = node;
        ++end[axis];
        const bool starts_inside = grid_.is_inside(node);
        if (starts_inside == grid_.is_inside(end) || node[u] == 0 || node[v] == 0)
            return;
        std::vector<std::uint32_t> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto [back_u, back_v] = cells_about_edge[i];
            glm::ivec3 cell = node;
            cell[u] -= back_u;
            cell[v] -= back_v;
            corners.push_back(first_vertex_[grid_.index(cell)] +
                              static_cast<std::uint32_t>(sheet(cell, edge_number(axis, back_u, back_v))));
            if (const auto extra = vertex_on_doubled_edge(node, axis, i))
                corners.push_back(*extra);
        }
        if (!starts_inside)
            std::reverse(corners.begin(), corners.end());
        if (corners.size() == 4)
            net_.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
        else
            add_fan(std::move(corners));
    }

    /// Where one sheet passes twice through the face between cells `i` and `i + 1` about the edge, and does
    /// so in both cells, the net would use the edge between the two vertices four times. One of the two
    /// passages gets a vertex of its own; this gives it, if the polygon of this edge belongs to that passage.
    std::optional<std::uint32_t> vertex_on_doubled_edge(const glm::ivec3& node, int axis, std::size_t i) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const int away = i % 2 == 0 ? v : u;
        glm::ivec3 lower = node;
        if (i == 1 || i == 2)
            --lower[away];
        glm::ivec3 beside = lower;
        glm::ivec3 above = lower;
        ++beside[away];
        ++above[axis];
        const glm::ivec3 opposite = beside + above - lower;
        const bool inside = grid_.is_inside(lower);
        if (grid_.is_inside(opposite) != inside || grid_.is_inside(beside) == inside ||
            grid_.is_inside(above) == inside)
            return std::nullopt;
        for (const std::size_t k : {i, (i + 1) % 4}) {
            std::array<int, 2> back = cells_about_edge[k];
            glm::ivec3 cell = node;
            cell[u] -= back[0];
            cell[v] -= back[1];
            const int here = sheet(cell, edge_number(axis, back[0], back[1]));
            int& across = back[away == u ? 0 : 1];
            across = 1 - across;
            if (sheet(cell, edge_number(axis, back[0], back[1])) != here)
                return std::nullopt;
        }
        // A passage goes round one of the two inside corners; the upper one gets the vertex.
        const glm::ivec3 corner =
            inside ? opposite : (grid_.index(beside) > grid_.index(above) ? beside : above);
        glm::ivec3 end = node;
        ++end[axis];
        if (corner != node && corner != end)
            return std::nullopt;
        const std::size_t face = grid_.index(lower) * 3 + static_cast<std::size_t>(3 - axis - away);
        const auto [entry, is_new] =
            vertex_of_face_.try_emplace(face, static_cast<std::uint32_t>(net_.positions.size()));
        if (is_new) {
            const std::array<glm::ivec3, 2> outside =
                inside ? std::array{beside, above} : std::array{lower, opposite};
            net_.positions.push_back(grid_.place(0.5 * (cut(corner, outside[0]) + cut(corner, outside[1]))));
            vertices_of_faces_from_ = std::min(vertices_of_faces_from_, entry->second);
        }
        return entry->second;
    }

    /// Cuts up a polygon from a vertex that only this and one other polygon have, so that no cut is met
    /// twice.
    void add_fan(std::vector<std::uint32_t> corners) {
        const auto apex = std::find_if(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
            return vertex >= vertices_of_faces_from_;
        });
        std::rotate(corners.begin(), apex, corners.end());
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            net_.triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
    }

    PolygonNet net_;
    const StretchedGrid& grid_;
    std::vector<std::uint32_t> first_vertex_;                  ///< of each cell, by its lowest node
    std::map<std::size_t, std::uint32_t> vertex_of_face_;      ///< for passages with a vertex of their own
    std::uint32_t vertices_of_faces_from_ = ~std::uint32_t{0}; ///< they come after the cells' vertices
};

} // namespace

PolygonNet surface_net(const StretchedGrid& grid) { return NetBuilder(grid).build(); }

} // namespace overt
