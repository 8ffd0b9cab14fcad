#include "experiment/scene/files/stl_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/making/vertex_welder.h"

namespace overt {
namespace {

// Binary STL, little-endian: 80 bytes of comment, uint32 number of triangles, and for each triangle 12 floats
// (normal, three corners) and a uint16 attribute.
constexpr std::size_t header_bytes = 84;
constexpr std::size_t triangle_bytes = 50;

std::uint64_t promised_triangles(std::string_view bytes) {
    return stored_value<std::uint32_t>(bytes.data() + 80, std::endian::little);
}

bool is_word(std::string_view word, std::string_view lower_case) {
    return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                      [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

bool looks_like_text(std::string_view beginning) {
    return std::none_of(beginning.begin(), beginning.end(), [](char c) {
        return (c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r') || c == '\x7f';
    });
}

float finite_coordinate(const MeshSource& source, std::size_t offset, std::size_t triangle) {
    const auto value = stored_value<float>(source.bytes().data() + offset, std::endian::little);
    if (!std::isfinite(value)) {
        source.fail_at_byte(offset,
                            fmt::format("a corner of triangle {} (counted from 0) has the coordinate {}; "
                                        "coordinates must be finite.",
                                        triangle, value));
    }
    return value;
}

class TextStlReader {
  public:
    explicit TextStlReader(const MeshSource& source) : text_(source) {}

    RawMesh read() {
        while (!text_.next().empty()) { // "solid", by which the file was recognised, or one more
            text_.rest_of_line();
            while (!read_facet_or_end()) {
            }
            if (is_padding(text_.source().bytes().substr(text_.offset())))
                break;
            if (const std::string_view word = MeshText(text_).next(); !is_word(word, "solid")) {
                text_.next();
                text_.fail(fmt::format("{} stands where 'solid' or the end of the file should be.",
                                       MeshText::quoted(word)));
            }
        }
        if (mesh_.triangles.empty())
            text_.source().fail("this STL file has no facets.");
        mesh_.positions = std::move(corners_).positions();
        return std::move(mesh_);
    }

  private:
    // True at "endsolid".
    bool read_facet_or_end() {
        const std::string_view word = text_.next();
        if (is_word(word, "endsolid")) {
            text_.rest_of_line();
            return true;
        }
        if (!is_word(word, "facet"))
            refuse(word, "facet' or 'endsolid");
        expect("normal");
        for (int i = 0; i < 3; ++i)
            text_.next(); // recomputed from the corners, so never mind what it says
        expect("outer");
        expect("loop");
        glm::uvec3 triangle;
        for (int i = 0; i < 3; ++i)
            triangle[i] = corner();
        expect("endloop");
        expect("endfacet");
        mesh_.triangles.push_back(triangle);
        return false;
    }

    std::uint32_t corner() {
        expect("vertex");
        const auto owner = [this] {
            return fmt::format("a corner of facet {} (counted from 0)", mesh_.triangles.size());
        };
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = text_.coordinate("xyz"[axis], owner);
        return corners_.index_of(position);
    }

    void expect(std::string_view keyword) {
        if (const std::string_view word = text_.next(); !is_word(word, keyword))
            refuse(word, keyword);
    }

    [[noreturn]] void refuse(std::string_view word, std::string_view expected) const {
        if (word.empty()) {
            text_.fail(fmt::format("the STL file ends where '{}' should be; {} facets are complete. Copy or "
                                   "export it again.",
                                   expected, mesh_.triangles.size()));
        }
        text_.fail(fmt::format("{} stands where '{}' should be.", MeshText::quoted(word), expected));
    }

    MeshText text_;
    VertexWelder corners_;
    RawMesh mesh_;
};

} // namespace

StlForm stl_form(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    if (bytes.size() > header_bytes &&
        bytes.size() == header_bytes + triangle_bytes * promised_triangles(bytes)) {
        return StlForm::binary;
    }
    const std::string_view first_word = MeshText(source).next();
    return is_word(first_word, "solid") && looks_like_text(bytes.substr(0, 1024)) ? StlForm::text
                                                                                  : StlForm::none;
}

RawMesh read_binary_stl(const MeshSource& source) {
    const std::string_view bytes = source.bytes();
    if (bytes.size() < header_bytes) {
        source.fail_at_byte(bytes.size(),
                            fmt::format("the file ends inside the {} bytes of a binary STL header. "
                                        "Copy or export it again.",
                                        header_bytes));
    }
    const std::uint64_t count = promised_triangles(bytes);
    const std::size_t found = (bytes.size() - header_bytes) / triangle_bytes;
    if (count == 0)
        source.fail_at_byte(80, "this STL file has no triangles.");
    if (count > found) {
        source.fail_at_byte(bytes.size(),
                            fmt::format("the header promises {} triangles, which take {} bytes, but the "
                                        "file has {} bytes with {} complete triangles. It is cut off or "
                                        "no binary STL file; copy or export it again.",
                                        count, header_bytes + triangle_bytes * count, bytes.size(), found));
    }
    const std::size_t end = header_bytes + triangle_bytes * count;
    if (!is_padding(bytes.substr(end))) {
        source.fail_at_byte(
            end, fmt::format("the file goes on after the {} triangles that its header promises; header "
                             "and content do not belong together.",
                             count));
    }
    RawMesh mesh;
    VertexWelder corners;
    mesh.triangles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t offset =
                header_bytes + i * triangle_bytes + 12 + static_cast<std::size_t>(corner) * 12;
            const float x = finite_coordinate(source, offset, i);
            const float y = finite_coordinate(source, offset + 4, i);
            const float z = finite_coordinate(source, offset + 8, i);
            mesh.triangles[i][corner] = corners.index_of({x, y, z});
        }
    }
    mesh.positions = std::move(corners).positions();
    return mesh;
}

RawMesh read_text_stl(const MeshSource& source) { return TextStlReader(source).read(); }

} // namespace overt
