#include "experiment/scene/files/ply_header.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "experiment/scene/files/mesh_text.h"

namespace overt {
namespace {

struct TypeWord {
    std::string_view word;
    PlyType type;
};

// Turk's names, and those with sizes that came into use later.
constexpr std::array type_words{
    TypeWord{"char", PlyType::int8},      TypeWord{"int8", PlyType::int8},
    TypeWord{"uchar", PlyType::uint8},    TypeWord{"uint8", PlyType::uint8},
    TypeWord{"short", PlyType::int16},    TypeWord{"int16", PlyType::int16},
    TypeWord{"ushort", PlyType::uint16},  TypeWord{"uint16", PlyType::uint16},
    TypeWord{"int", PlyType::int32},      TypeWord{"int32", PlyType::int32},
    TypeWord{"uint", PlyType::uint32},    TypeWord{"uint32", PlyType::uint32},
    TypeWord{"int64", PlyType::int64},    TypeWord{"uint64", PlyType::uint64},
    TypeWord{"float", PlyType::float32},  TypeWord{"float32", PlyType::float32},
    TypeWord{"double", PlyType::float64}, TypeWord{"float64", PlyType::float64},
};

PlyType type_in(MeshText& text) {
    const std::string_view word = text.next_in_line();
    for (const TypeWord& known : type_words) {
        if (known.word == word)
            return known.type;
    }
    text.fail(
        fmt::format("{} is no PLY type; known are char, uchar, short, ushort, int, uint, float and double.",
                    MeshText::quoted(word)));
}

PlyFormat format_in(MeshText& text) {
    const std::string_view word = text.next_in_line();
    PlyFormat format{};
    if (word == "ascii") {
        format = PlyFormat::text;
    } else if (word == "binary_little_endian") {
        format = PlyFormat::little_endian;
    } else if (word == "binary_big_endian") {
        format = PlyFormat::big_endian;
    } else {
        text.fail(
            fmt::format("{} is no PLY format; known are ascii, binary_little_endian and binary_big_endian.",
                        MeshText::quoted(word)));
    }
    if (const std::string_view version = text.next_in_line(); version != "1.0") {
        text.fail(fmt::format("the PLY version is {}; only 1.0 is known.", MeshText::quoted(version)));
    }
    return format;
}

PlyElement element_in(MeshText& text, const PlyHeader& header) {
    PlyElement element;
    element.name = text.next_in_line();
    if (element.name.empty())
        text.fail("this element has no name.");
    if (header.find(element.name))
        text.fail(fmt::format("element {} is there twice.", element.name));
    const std::string_view word = text.next_in_line();
    const std::optional<std::int64_t> count = MeshText::integer_in(word);
    if (!count || *count < 0) {
        text.fail(
            fmt::format("{} is no possible number of {} elements.", MeshText::quoted(word), element.name));
    }
    element.count = static_cast<std::uint64_t>(*count);
    if (element.name == "vertex" && element.count > max_mesh_vertices) {
        text.fail(fmt::format("the header promises {} vertices; at most {} can be read.", element.count,
                              max_mesh_vertices));
    }
    return element;
}

PlyProperty property_in(MeshText& text, const PlyHeader& header) {
    if (header.elements.empty())
        text.fail("this property stands before the first element.");
    PlyProperty property;
    MeshText ahead = text;
    if (ahead.next_in_line() == "list") {
        text.next_in_line();
        property.count_type = type_in(text);
        if (!is_integer(*property.count_type))
            text.fail("the length of a list must be an integer.");
    }
    property.type = type_in(text);
    property.name = text.next_in_line();
    if (property.name.empty())
        text.fail("this property has no name.");
    for (const PlyProperty& earlier : header.elements.back().properties) {
        if (earlier.name == property.name) {
            text.fail(fmt::format("property {} of element {} is there twice.", property.name,
                                  header.elements.back().name));
        }
    }
    return property;
}

// `comment part LABEL NAME` and `comment TextureFile NAME`; every other comment is passed over.
void read_comment(MeshText& text, PlyHeader& header) {
    const std::string_view word = text.next_in_line();
    if (word == "TextureFile") {
        std::string name(text.rest_of_line());
        name.erase(0, name.find_first_not_of(" \t"));
        name.erase(name.find_last_not_of(" \t") + 1);
        header.picture_files.push_back(std::move(name));
    }
    if (word != "part")
        return;
    const std::optional<std::int64_t> label = MeshText::integer_in(text.next_in_line());
    if (!label || static_cast<std::int64_t>(static_cast<PartLabel>(*label)) != *label)
        return;
    header.part_names[static_cast<PartLabel>(*label)] = text.rest_of_line();
}

void expect_triangle_mesh(const PlyHeader& header, const MeshSource& source) {
    const PlyElement* vertices = header.find("vertex");
    if (!vertices)
        source.fail("the PLY header names no element vertex, so there is nothing to show.");
    for (const std::string_view axis : {"x", "y", "z"}) {
        if (!find_property(*vertices, {axis}, false)) {
            source.fail(fmt::format("the PLY header gives element vertex no property {}.", axis));
        }
    }
    bool has_faces = false;
    for (const std::string_view name : {"face", "tristrips"}) {
        const PlyElement* const faces = header.find(name);
        if (!faces || faces->count == 0)
            continue;
        has_faces = true;
        if (!find_corner_list(*faces)) {
            source.fail(fmt::format(
                "the PLY header gives element {} no list vertex_indices (or vertex_index).", name));
        }
    }
    if (!has_faces || vertices->count == 0)
        source.fail("this PLY file has no faces; a surface is needed, not a cloud of points.");
}

} // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
        return 1;
    case PlyType::int16:
    case PlyType::uint16:
        return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
        return 4;
    case PlyType::int64:
    case PlyType::uint64:
    case PlyType::float64:
        return 8;
    }
    return 0;
}

bool is_integer(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

const PlyElement* PlyHeader::find(std::string_view element_name) const {
    const auto found = std::ranges::find(elements, element_name, &PlyElement::name);
    return found == elements.end() ? nullptr : &*found;
}

std::optional<std::size_t> find_property(const PlyElement& element,
                                         std::initializer_list<std::string_view> names, bool is_list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (property.count_type.has_value() != is_list)
            continue;
        if (std::find(names.begin(), names.end(), property.name) != names.end())
            return i;
    }
    return std::nullopt;
}

std::optional<std::size_t> find_corner_list(const PlyElement& element) {
    return find_property(element, {"vertex_indices", "vertex_index"}, true);
}

PlyHeader read_ply_header(const MeshSource& source) {
    PlyHeader header;
    bool has_format = false;
    MeshText text(source);
    text.next_in_line(); // "ply", by which the file was recognised
    while (text.to_next_line()) {
        const std::string_view word = text.next_in_line();
        if (word == "comment") {
            read_comment(text, header);
        } else if (word == "format") {
            header.format = format_in(text);
            has_format = true;
        } else if (word == "element") {
            header.elements.push_back(element_in(text, header));
        } else if (word == "property") {
            PlyProperty property = property_in(text, header);
            header.elements.back().properties.push_back(std::move(property));
        } else if (word == "end_header") {
            if (!text.to_next_line())
                source.fail("the PLY file ends with its header.");
            if (!has_format)
                source.fail("the PLY header has no line 'format'.");
            header.body_offset = text.offset();
            header.body_line = text.line();
            expect_triangle_mesh(header, source);
            return header;
        } else if (!word.empty() && word != "obj_info") {
            text.fail(fmt::format("{} is no word of a PLY header.", MeshText::quoted(word)));
        }
    }
    text.fail(
        "the file ends inside its PLY header: the line end_header is missing. Copy or export it again.");
}

} // namespace overt
