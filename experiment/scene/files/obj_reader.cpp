#include "experiment/scene/files/obj_reader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>

#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/obj_look.h"
#include "experiment/scene/making/face_cutting.h"

namespace overt {
namespace {

class ObjReader {
  public:
    // `refused`: the vertex, counted from 0, whose coordinates are known to be none.
    ObjReader(const MeshSource& source, bool wants_look, std::optional<std::size_t> refused = {})
        : source_(source), text_(source, 0, 1, LineJoining::backslash), look_(text_, wants_look),
          refused_(refused) {}

    RawMesh read() {
        do {
            const std::string_view statement = text_.next_in_line();
            if (statement == "v") {
                read_vertex();
            } else if (statement == "f" || statement == "fo") {
                read_face();
            } else if (statement == "o" || statement == "g") {
                begin_group();
            } else if (statement == "vt" && look_.is_wanted()) {
                read_place();
            } else if (statement == "usemtl") {
                look_.use_material(text_.rest_of_line());
            } else if (statement == "mtllib") {
                look_.add_libraries(text_.rest_of_line());
            }
        } while (text_.to_next_line());
        expect_known_vertices();
        if (mesh_.triangles.empty())
            source_.fail("this OBJ file has no faces (lines 'f ...').");
        if (const auto vertex = first_used_without_place(mesh_); vertex && !refused_)
            return ObjReader(source_, look_.is_wanted(), vertex).read();
        fans_.cut();
        keep_groups_if_several();
        look_.finish(mesh_, source_);
        return std::move(mesh_);
    }

  private:
    void read_vertex() {
        if (mesh_.positions.size() == max_mesh_vertices)
            text_.fail("this mesh has too many vertices.");
        const auto owner = [this] { return fmt::format("vertex {}", mesh_.positions.size() + 1); };
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            position[axis] = text_.number("xyz"[axis], owner);
            if (is_coordinate(position[axis]))
                continue;
            if (mesh_.positions.size() == refused_)
                text_.refuse_coordinate("xyz"[axis], owner());
            position[axis] = std::numeric_limits<double>::quiet_NaN();
        }
        mesh_.positions.push_back(position);
        if (look_.is_wanted())
            read_colour();
    }

    // Three numbers behind the coordinates; a single one is a weight.
    void read_colour() {
        glm::vec3 colour;
        for (int channel = 0; channel < 3; ++channel) {
            const std::optional<double> value = MeshText::number_in(text_.next_in_line());
            if (!value)
                return;
            colour[channel] = static_cast<float>(*value);
        }
        look_.add_vertex_colour(mesh_.positions.size() - 1, colour);
    }

    void read_place() {
        const auto owner = [] { return std::string("this place on a picture (vt)"); };
        const double u = text_.coordinate('u', owner);
        // A picture may have one row alone.
        const std::optional<double> v = MeshText::number_in(text_.next_in_line());
        look_.add_place(u, v && is_coordinate(*v) ? *v : 0.0);
    }

    void read_face() {
        fans_.begin_face();
        look_.begin_face();
        const std::size_t first = mesh_.triangles.size();
        int corners = 0;
        for (std::string_view word = text_.next_in_line(); !word.empty(); word = text_.next_in_line()) {
            if (word.front() == '#')
                break;
            const std::uint32_t vertex = vertex_index(word);
            fans_.add_corner(vertex);
            look_.add_corner(vertex, word);
            ++corners;
        }
        mesh_.triangle_labels.resize(mesh_.triangles.size(), group_);
        if (corners < 3)
            text_.fail(fmt::format("this face has {} corners; a face has at least 3.", corners));
        look_.end_face(first, mesh_.triangles.size());
    }

    std::uint32_t vertex_index(std::string_view corner) {
        const std::optional<std::int64_t> index = MeshText::integer_in(corner.substr(0, corner.find('/')));
        if (!index)
            text_.fail(fmt::format("{} is no corner of a face.", MeshText::quoted(corner)));
        const auto count = static_cast<std::int64_t>(mesh_.positions.size());
        // Vertices count from 1; negative numbers count back from the last vertex so far.
        const std::int64_t from_zero = *index < 0 ? count + *index : *index - 1;
        if (*index == 0 || from_zero < 0 || *index > static_cast<std::int64_t>(max_mesh_vertices)) {
            text_.fail(
                fmt::format("this face uses vertex {}, but {} vertices were read so far.", *index, count));
        }
        // A face may stand before its vertices; whether they come is known at the end.
        if (from_zero >= count && *index > highest_) {
            highest_ = *index;
            highest_place_ = text_.place();
        }
        return static_cast<std::uint32_t>(from_zero);
    }

    void begin_group() {
        std::string name;
        for (std::string_view word = text_.next_in_line(); !word.empty(); word = text_.next_in_line()) {
            if (word.front() == '#')
                break;
            if (!name.empty())
                name += ' ';
            name += word;
        }
        group_ = group_named(name.empty() ? unnamed_ : name);
    }

    PartLabel group_named(const std::string& name) {
        const auto [found, added] = groups_.try_emplace(name, static_cast<PartLabel>(groups_.size()));
        if (added)
            names_.push_back(name);
        return found->second;
    }

    void expect_known_vertices() const {
        if (highest_ <= static_cast<std::int64_t>(mesh_.positions.size()))
            return;
        source_.fail_at(highest_place_.line, highest_place_.column,
                        fmt::format("this face uses vertex {}, but the file has only {} vertices.", highest_,
                                    mesh_.positions.size()));
    }

    void keep_groups_if_several() {
        std::vector<PartLabel>& labels = mesh_.triangle_labels;
        const bool one_group = std::all_of(labels.begin(), labels.end(),
                                           [&](PartLabel label) { return label == labels.front(); });
        if (one_group) {
            labels = {};
            return;
        }
        for (const PartLabel label : labels) {
            mesh_.part_names.try_emplace(label, names_[static_cast<std::size_t>(label)]);
        }
    }

    const MeshSource& source_;
    MeshText text_;
    RawMesh mesh_;
    FaceFans fans_{mesh_};
    ObjLook look_;
    std::optional<std::size_t> refused_;
    std::int64_t highest_ = 0; ///< largest vertex number used before its vertex was read
    TextPlace highest_place_;
    const std::string unnamed_ = "body";
    std::unordered_map<std::string, PartLabel> groups_;
    std::vector<std::string> names_;
    PartLabel group_ = group_named(unnamed_);
};

} // namespace

bool is_obj(const MeshSource& source) {
    constexpr std::array statements{"v", "vt", "vn", "vp", "f", "o", "g", "s", "mtllib", "usemtl"};
    MeshText text(source);
    do {
        const std::string_view word = text.next_in_line();
        if (word.empty() || word.front() == '#')
            continue;
        return std::find(statements.begin(), statements.end(), word) != statements.end();
    } while (text.to_next_line());
    return false;
}

RawMesh read_obj(const MeshSource& source, MeshWanted wanted) {
    return ObjReader(source, wanted == MeshWanted::appearance).read();
}

} // namespace overt
