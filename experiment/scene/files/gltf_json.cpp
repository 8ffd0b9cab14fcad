#include "experiment/scene/files/gltf_json.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Larger JSON would take more memory than any mesh: its numbers lie in buffers.
constexpr std::size_t most_json_bytes = std::size_t{64} << 20;

/// RFC 6901: ~ and / are written as ~0 and ~1.
std::string pointer_part(std::string_view key) {
    std::string part;
    for (const char letter : key)
        part += letter == '~' ? "~0" : letter == '/' ? "~1" : std::string(1, letter);
    return part;
}

/// The parts of a .glb: a header of 12 bytes, then chunks.
struct GlbParts {
    std::string_view json, binary;
    std::size_t json_offset = 0;
    bool has_binary = false;
};

GlbParts parts_of_glb(const MeshSource& source) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
    const std::string_view bytes = source.bytes();
    const auto number_at = [&](std::size_t offset) {
        return stored_value<std::uint32_t>(bytes.data() + offset, std::endian::little);
    };
    if (bytes.size() < header_bytes + chunk_header_bytes)
        source.fail_at_byte(bytes.size(), "this .glb ends in its header.");
    if (const std::uint32_t version = number_at(4); version != 2)
        source.fail_at_byte(
            4, fmt::format("this is glTF {}; overt reads glTF 2.0: export it as that.", version));
    const std::size_t length = number_at(8);
    if (length > bytes.size() || length < header_bytes + chunk_header_bytes)
        source.fail_at_byte(8,
                            fmt::format("this .glb says that it has {} bytes, but it has {}: it is cut off.",
                                        length, bytes.size()));
    GlbParts parts;
    std::size_t at = header_bytes;
    for (int chunk = 0; length - at >= chunk_header_bytes; ++chunk) {
        const std::size_t size = number_at(at);
        const std::uint32_t kind = number_at(at + 4);
        const std::size_t begin = at + chunk_header_bytes;
        if (size > length - begin)
            source.fail_at_byte(
                at, fmt::format("this chunk says that it has {} bytes; {} are left.", size, length - begin));
        if (chunk == 0 && kind != json_chunk)
            source.fail_at_byte(at + 4, "the first chunk of a .glb is its JSON; this is another.");
        if (chunk == 0) {
            parts.json = bytes.substr(begin, size);
            parts.json_offset = begin;
        } else if (kind == binary_chunk && !parts.has_binary) {
            parts.binary = bytes.substr(begin, size);
            parts.has_binary = true;
        }
        at = begin + size;
        // Chunks begin at multiples of four.
        at += std::min(length - at, (4 - at % 4) % 4);
    }
    return parts;
}

nlohmann::json parsed_json(const MeshSource& source, std::string_view text, std::size_t offset) {
    if (text.size() > most_json_bytes)
        source.fail(fmt::format("its JSON has {} bytes; more than {} MiB are not read.", text.size(),
                                most_json_bytes >> 20));
    try {
        return nlohmann::json::parse(text.begin(), text.end());
    } catch (const nlohmann::json::parse_error& error) {
        source.fail_at_byte(offset + std::min(text.size(), error.byte > 0 ? error.byte - 1 : 0),
                            "this is no JSON.");
    }
}

} // namespace

std::optional<GltfValue> GltfValue::find(std::string_view key) const {
    if (!value_->is_object())
        fail("an object {…} is expected here.");
    const auto found = value_->find(std::string(key));
    if (found == value_->end())
        return std::nullopt;
    return GltfValue(*source_, *found, pointer_ + "/" + pointer_part(key));
}

GltfValue GltfValue::at(std::string_view key) const {
    std::optional<GltfValue> found = find(key);
    if (!found)
        fail(fmt::format("\"{}\" is missing.", key));
    return std::move(*found);
}

GltfValue GltfValue::item(std::size_t index) const {
    if (index >= size())
        fail(fmt::format("there is no item {} (counted from 0): it has {}.", index, size()));
    return {*source_, (*value_)[index], fmt::format("{}/{}", pointer_, index)};
}

std::size_t GltfValue::size() const {
    if (!value_->is_array())
        fail("a list […] is expected here.");
    return value_->size();
}

std::vector<std::string> GltfValue::keys() const {
    if (!value_->is_object())
        fail("an object {…} is expected here.");
    std::vector<std::string> keys;
    for (auto member = value_->begin(); member != value_->end(); ++member)
        keys.push_back(member.key());
    return keys;
}

double GltfValue::number() const {
    if (!value_->is_number())
        fail("a number is expected here.");
    const auto number = value_->get<double>();
    if (!std::isfinite(number))
        fail("this number is too large.");
    return number;
}

double GltfValue::number_or(std::string_view key, double otherwise) const {
    const std::optional<GltfValue> found = find(key);
    return found ? found->number() : otherwise;
}

std::uint64_t GltfValue::whole(std::uint64_t most) const {
    const double value = number();
    if (!(value >= 0.0) || value > static_cast<double>(most) || value != std::floor(value))
        fail(fmt::format("a whole number from 0 to {} is expected here.", most));
    return static_cast<std::uint64_t>(value);
}

std::uint64_t GltfValue::whole_or(std::string_view key, std::uint64_t otherwise) const {
    const std::optional<GltfValue> found = find(key);
    return found ? found->whole() : otherwise;
}

bool GltfValue::truth_or(std::string_view key, bool otherwise) const {
    const std::optional<GltfValue> found = find(key);
    if (!found)
        return otherwise;
    if (!found->value_->is_boolean())
        found->fail("true or false is expected here.");
    return found->value_->get<bool>();
}

const std::string& GltfValue::text() const {
    if (!value_->is_string())
        fail("a text is expected here.");
    return value_->get_ref<const std::string&>();
}

std::string GltfValue::text_or_empty(std::string_view key) const {
    const std::optional<GltfValue> found = find(key);
    return found ? found->text() : std::string();
}

void GltfValue::fail(std::string_view message) const {
    source_->fail(fmt::format("{}: {}", pointer_.empty() ? "/" : pointer_, message));
}

GltfContent read_gltf_content(const MeshSource& source) {
    GltfContent content;
    if (source.bytes().starts_with("glTF")) {
        const GlbParts parts = parts_of_glb(source);
        content.json = parsed_json(source, parts.json, parts.json_offset);
        content.binary = parts.binary;
        content.has_binary = parts.has_binary;
    } else {
        content.json = parsed_json(source, source.bytes(), 0);
    }
    const GltfValue root(source, content.json, "");
    const std::string version = root.at("asset").at("version").text();
    if (!version.starts_with("2."))
        root.at("asset").at("version").fail("overt reads glTF 2.0: export it as that.");
    return content;
}

GltfValue gltf_entry(const GltfValue& root, std::string_view list, const GltfValue& index) {
    const std::uint64_t number = index.whole();
    const std::optional<GltfValue> entries = root.find(list);
    if (!entries || number >= entries->size())
        index.fail(fmt::format("there is no entry {} of \"{}\".", number, list));
    return entries->item(number);
}

} // namespace overt
