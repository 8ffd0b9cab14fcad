#include "experiment/scene/files/gltf_buffers.h"

#include <cstring>

#include <fmt/format.h>

#include "experiment/base/base64.h"
#include "experiment/base/path_inside.h"
#include "experiment/base/safe_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_text.h"
#include "experiment/scene/files/meshopt_view.h"

namespace overt {
namespace {

/// Of one file beside a mesh.
constexpr std::size_t most_buffer_bytes = std::size_t{8} << 30;
/// Of a data: URI, as letters: they are decoded by numbers of 31 bits.
constexpr std::size_t most_letters = std::size_t{1} << 30;

int hex_value(char letter) {
    if (letter >= '0' && letter <= '9')
        return letter - '0';
    const char lower = static_cast<char>(letter | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// With each %20 as the character that it stands for (RFC 3986, 2.1).
std::string without_percents(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0) {
            text += static_cast<char>(16 * hex_value(uri[i + 1]) + hex_value(uri[i + 2]));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// "http:", "file:", and with them Windows' "C:": letters before a colon.
bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 && uri.find('/') > colon;
}

} // namespace

std::string_view GltfBuffers::resource(const GltfValue& uri, std::string* media_type) {
    const std::string& text = uri.text();
    if (media_type && text.starts_with("data:"))
        *media_type = text.substr(5, text.find_first_of(";,") - 5);
    if (const auto known = resources_.find(text); known != resources_.end())
        return known->second;
    std::string bytes;
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
            uri.fail("this data: URI is not in base64, as those of glTF are.");
        if (text.size() > most_letters)
            uri.fail("this data: URI is too long; put its bytes into a file, or into a .glb.");
        const auto decoded = bytes_of_base64(std::string_view(text).substr(comma + 1));
        if (!decoded)
            uri.fail("the base64 of this data: URI is damaged.");
        bytes.assign(reinterpret_cast<const char*>(decoded->data()), decoded->size());
    } else {
        const std::string name = without_percents(text);
        if (has_scheme(name) || !stays_inside(name))
            uri.fail(fmt::format(
                "refers to {} outside its folder; nothing is read from there: put the file beside "
                "the mesh, or export one .glb.",
                MeshText::quoted(name)));
        const std::filesystem::path folder = uri.source().path().parent_path();
        if (const std::string why = why_no_file_inside(folder, name); !why.empty())
            uri.fail(fmt::format("the file {} beside the mesh {}.", MeshText::quoted(name), why));
        int error = 0;
        std::optional<std::string> read = read_whole_file(folder / name, most_buffer_bytes, error);
        if (!read)
            uri.fail(fmt::format("the file {} beside the mesh cannot be read: {}.", MeshText::quoted(name),
                                 std::strerror(error)));
        bytes = std::move(*read);
    }
    bytes_there_ += bytes.size();
    kept_.push_back(std::move(bytes));
    return resources_[text] = kept_.back();
}

std::vector<std::string> GltfBuffers::files() const {
    std::vector<std::string> files;
    for (const auto& [uri, bytes] : resources_)
        if (!uri.starts_with("data:"))
            files.push_back(printable_text(without_percents(uri)));
    return files;
}

std::string_view GltfBuffers::buffer(const GltfValue& index) {
    const GltfValue buffer = gltf_entry(root_, "buffers", index);
    const std::size_t number = index.whole();
    if (const auto known = buffers_.find(number); known != buffers_.end())
        return known->second;
    const std::size_t length = buffer.at("byteLength").whole();
    std::string_view bytes;
    if (const std::optional<GltfValue> uri = buffer.find("uri")) {
        bytes = resource(*uri);
    } else {
        if (number != 0 || !content_->has_binary)
            buffer.fail("this buffer has no \"uri\", and the file has no binary part that it could be.");
        bytes = content_->binary;
    }
    if (bytes.size() < length)
        buffer.fail(fmt::format("this buffer is to have {} bytes, but {} are there: it is cut off.", length,
                                bytes.size()));
    return buffers_[number] = bytes.substr(0, length);
}

GltfBuffers::View GltfBuffers::view(const GltfValue& index) {
    const GltfValue view = gltf_entry(root_, "bufferViews", index);
    std::size_t stride = view.whole_or("byteStride", 0);
    if (view.find("byteStride") && (stride < 4 || stride > 252))
        view.at("byteStride").fail("a stride is from 4 to 252 bytes.");
    if (const std::optional<GltfValue> extensions = view.find("extensions"))
        for (const std::string_view name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
            if (const std::optional<GltfValue> packed = extensions->find(name)) {
                if (packed->at("mode").text() == "ATTRIBUTES" && stride == 0)
                    stride = packed->at("byteStride").whole();
                return {unpacked(index.whole(), *packed), stride};
            }
    return {bytes_of(view), stride};
}

std::string_view GltfBuffers::bytes_of(const GltfValue& place) {
    const std::string_view bytes = buffer(place.at("buffer"));
    const std::size_t offset = place.whole_or("byteOffset", 0), length = place.at("byteLength").whole();
    if (offset > bytes.size() || length > bytes.size() - offset)
        place.fail(fmt::format("bytes {} to {} are outside its buffer, which has {}.", offset,
                               offset + length, bytes.size()));
    return bytes.substr(offset, length);
}

std::string_view GltfBuffers::unpacked(std::size_t view, const GltfValue& packed) {
    if (const auto known = unpacked_.find(view); known != unpacked_.end())
        return known->second;
    // Many views may unpack the same bytes.
    constexpr std::size_t always = std::size_t{64} << 20, for_each_byte = 64;
    std::string bytes = unpacked_by_meshopt(packed, bytes_of(packed));
    unpacked_bytes_ += bytes.size();
    if (unpacked_bytes_ > always + for_each_byte * bytes_read())
        packed.fail("the packed bytes of this file overlap: it is damaged.");
    kept_.push_back(std::move(bytes));
    return unpacked_[view] = kept_.back();
}

} // namespace overt
