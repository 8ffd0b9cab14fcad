#include "experiment/scene/files/freesurfer.h"

#include <map>
#include <vector>

#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/triangle_labels.h"

namespace overt {
namespace {

constexpr std::string_view triangle_file = "\xFF\xFF\xFE";

/// Goes through numbers with their most significant byte first.
class BigEndian {
  public:
    BigEndian(const MeshSource& source, std::size_t from) : source_(source), at_(from) {}

    template <class T> T next() {
        expect(sizeof(T), 1);
        const T value = stored_value<T>(source_.bytes().data() + at_, std::endian::big);
        at_ += sizeof(T);
        return value;
    }
    /// A number of things that take `bytes_each` at least, none of which may lie beyond the file.
    std::size_t count(std::string_view what, std::size_t bytes_each) {
        const std::size_t begin = at_;
        const auto count = next<std::int32_t>();
        if (count < 0 || static_cast<std::size_t>(count) > (source_.bytes().size() - at_) / bytes_each)
            source_.fail_at_byte(begin, fmt::format("{} {} are said to follow, and the file is too short "
                                                    "for them.",
                                                    count, what));
        return static_cast<std::size_t>(count);
    }
    /// With its length before it, and perhaps a zero byte at its end.
    std::string text() {
        const std::size_t length = count("letters", 1);
        const std::string_view bytes = source_.bytes().substr(at_, length);
        at_ += length;
        return std::string(bytes.substr(0, bytes.find('\0')));
    }
    std::size_t at() const { return at_; }
    [[noreturn]] void fail(std::string_view message) const { source_.fail_at_byte(at_, message); }

  private:
    void expect(std::size_t size, std::size_t count) const {
        if (source_.bytes().size() - at_ < size * count)
            source_.fail_at_byte(at_, "the file is cut off here.");
    }
    const MeshSource& source_;
    std::size_t at_;
};

/// A region of a colour table: its name by what vertices have for it.
std::map<std::int32_t, std::string> regions_of_table(BigEndian& bytes) {
    std::map<std::int32_t, std::string> names;
    const auto add = [&](const std::string& name) {
        const std::int32_t red = bytes.next<std::int32_t>(), green = bytes.next<std::int32_t>(),
                           blue = bytes.next<std::int32_t>();
        static_cast<void>(bytes.next<std::int32_t>()); // transparency
        names[red + 256 * green + 65536 * blue] = name;
    };
    const auto first = bytes.next<std::int32_t>();
    if (first > 0) { // the earlier form: so many entries
        static_cast<void>(bytes.text());
        for (std::int32_t entry = 0; entry < first; ++entry)
            add(bytes.text());
        return names;
    }
    if (first != -2)
        bytes.fail(fmt::format("a colour table of version {} is not known.", -first));
    static_cast<void>(bytes.next<std::int32_t>()); // the largest index
    static_cast<void>(bytes.text());               // where the table came from
    const std::size_t entries = bytes.count("regions", 24);
    for (std::size_t entry = 0; entry < entries; ++entry) {
        static_cast<void>(bytes.next<std::int32_t>()); // index
        add(bytes.text());
    }
    return names;
}

} // namespace

bool is_freesurfer_surface(const MeshSource& source) { return source.bytes().starts_with(triangle_file); }

RawMesh read_freesurfer_surface(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    // A line on who made it, and an empty one.
    const std::size_t text_end = bytes.find("\n\n");
    constexpr std::size_t longest_text = 4096;
    if (text_end == std::string_view::npos || text_end > longest_text)
        source.fail_at_byte(triangle_file.size(),
                            "a line of text and an empty one are expected here, as FreeSurfer writes them.");
    BigEndian numbers(source, text_end + 2);
    const std::size_t vertices = numbers.count("vertices", 12);
    const std::size_t triangles = numbers.count("triangles", 12);
    if (triangles == 0)
        numbers.fail("this file has no triangles; a surface is needed.");
    RawMesh mesh;
    mesh.positions.reserve(vertices);
    for (std::size_t i = 0; i < vertices; ++i) {
        const double x = numbers.next<float>(), y = numbers.next<float>(), z = numbers.next<float>();
        mesh.positions.emplace_back(x, y, z);
    }
    mesh.triangles.reserve(triangles);
    for (std::size_t i = 0; i < triangles; ++i) {
        glm::uvec3 corners;
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t begin = numbers.at();
            const auto index = numbers.next<std::int32_t>();
            if (index < 0 || static_cast<std::size_t>(index) >= vertices)
                source.fail_at_byte(begin, fmt::format("triangle {} has the vertex {}, and there are {}.", i,
                                                       index, vertices));
            corners[corner] = static_cast<std::uint32_t>(index);
        }
        mesh.triangles.push_back(corners);
    }
    if (const std::optional<std::size_t> vertex = first_used_without_place(mesh))
        source.fail(fmt::format("vertex {} has no place: a coordinate is no number.", *vertex));
    return mesh;
}

void label_by_annotation(RawMesh& mesh, const std::filesystem::path& file) {
    const MeshSource source(file);
    BigEndian bytes(source, 0);
    const std::size_t count = bytes.count("vertices", 8);
    if (count != mesh.positions.size())
        source.fail(
            fmt::format("annotates {} vertices, but the mesh has {}: give the surface that it belongs "
                        "to, with its vertices in their order.",
                        count, mesh.positions.size()));
    std::vector<std::int32_t> values(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = bytes.at();
        const auto vertex = bytes.next<std::int32_t>();
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= count)
            source.fail_at_byte(begin, fmt::format("annotates the vertex {} of {}.", vertex, count));
        values[static_cast<std::size_t>(vertex)] = bytes.next<std::int32_t>();
    }
    if (bytes.next<std::int32_t>() != 1)
        bytes.fail("has no table of colours, which names the regions.");
    const std::map<std::int32_t, std::string> names = regions_of_table(bytes);
    // Labels from 0 on, in the order of values; those of no region come last.
    std::map<std::int32_t, PartLabel> labels;
    mesh.part_names = {};
    for (const std::int32_t value : values)
        labels.try_emplace(value, 0);
    for (auto& [value, label] : labels) {
        label = static_cast<PartLabel>(mesh.part_names.size());
        const auto name = names.find(value);
        mesh.part_names[label] = name == names.end() ? "none" : name->second;
    }
    std::vector<PartLabel> of_vertices;
    of_vertices.reserve(count);
    for (const std::int32_t value : values)
        of_vertices.push_back(labels[value]);
    label_by_corners(mesh, of_vertices);
}

void label_by_region(RawMesh& mesh, const std::filesystem::path& file) {
    const MeshSource source(file);
    MeshText text(source);
    const auto whole = [&](std::string_view word, std::string_view what) {
        const std::optional<std::int64_t> number = MeshText::integer_in(word);
        if (!number || *number < 0)
            text.fail(fmt::format("{} is no {}.", MeshText::quoted(word), what));
        return static_cast<std::size_t>(*number);
    };
    if (source.bytes().front() == '#')
        text.to_next_line();
    const std::size_t count = whole(text.next_in_line(), "number of vertices");
    std::vector<PartLabel> labels(mesh.positions.size(), 0);
    for (std::size_t i = 0; i < count; ++i) {
        text.to_next_line();
        const std::string_view word = text.next_in_line();
        if (word.empty())
            text.fail(fmt::format("{} vertices are said to follow, and there are {}.", count, i));
        const std::size_t vertex = whole(word, "number of a vertex");
        if (vertex >= labels.size())
            text.fail(fmt::format("the mesh has {} vertices, counted from 0, and none with the number {}.",
                                  labels.size(), vertex));
        labels[vertex] = 1;
    }
    mesh.part_names = {{0, "body"}, {1, file.stem().string()}};
    label_by_corners(mesh, labels);
}

} // namespace overt
