#include "experiment/scene/ply_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view what) {
    throw RecordError(fmt::format("{}: the mesh cannot be written: {}. Make room, or check the folder's "
                                  "permissions.",
                                  path.string(), what));
}

std::string system_reason() { return std::generic_category().message(errno); }

// A file beside `path` that takes its place when everything is written, and vanishes otherwise.
class ReplacementFile {
  public:
    explicit ReplacementFile(std::filesystem::path path)
        : path_(std::move(path)), name_(path_.string() + ".XXXXXX") {
        descriptor_ = ::mkstemp(name_.data());
        if (descriptor_ < 0)
            refuse(path_, system_reason());
    }
    ~ReplacementFile() {
        if (descriptor_ < 0)
            return;
        ::close(descriptor_);
        ::unlink(name_.c_str());
    }
    ReplacementFile(const ReplacementFile&) = delete;
    ReplacementFile& operator=(const ReplacementFile&) = delete;

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ::ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR)
                continue;
            if (written < 0)
                refuse(path_, system_reason());
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void take_its_place() {
        // mkstemp makes files that only their owner may read; a mesh is no secret.
        if (::fchmod(descriptor_, 0644) != 0 || ::fsync(descriptor_) != 0)
            refuse(path_, system_reason());
        if (::rename(name_.c_str(), path_.c_str()) != 0)
            refuse(path_, system_reason());
        ::close(descriptor_);
        descriptor_ = -1;
    }

  private:
    std::filesystem::path path_;
    std::string name_;
    int descriptor_ = -1;
};

template <class T> char* put(char* at, T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big)
        std::reverse(bytes.begin(), bytes.end());
    std::memcpy(at, bytes.data(), bytes.size());
    return at + bytes.size();
}

std::string header_of(const std::filesystem::path& path, const Mesh& mesh) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t part = 0; part < mesh.part_names.size(); ++part) {
        const std::string& name = mesh.part_names[part];
        if (name.find_first_of("\r\n") != std::string_view::npos)
            refuse(path, fmt::format("part name {} has a line end", part));
        header += fmt::format("comment part {} {}\n", part, name);
    }
    header += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                          mesh.positions.size());
    header += fmt::format(
        "element face {}\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n",
        mesh.triangles.size());
    return header;
}

// Writes items in portions, so that a large mesh is not in memory a second time.
template <class Put>
void write_all(ReplacementFile& file, std::size_t count, std::size_t item_bytes, const Put& put_item) {
    constexpr std::size_t portion = 65536;
    std::string buffer(portion * item_bytes, '\0');
    for (std::size_t begin = 0; begin < count; begin += portion) {
        const std::size_t end = std::min(count, begin + portion);
        char* at = buffer.data();
        for (std::size_t i = begin; i < end; ++i)
            at = put_item(at, i);
        file.write({buffer.data(), (end - begin) * item_bytes});
    }
}

} // namespace

void write_ply(const std::filesystem::path& path, const Mesh& mesh) {
    OVERT_EXPECTS(mesh.triangle_parts.size() == mesh.triangles.size());
    ReplacementFile file(path);
    file.write(header_of(path, mesh));
    write_all(file, mesh.positions.size(), 12, [&](char* at, std::size_t i) {
        const glm::vec3& position = mesh.positions[i];
        return put(put(put(at, position.x), position.y), position.z);
    });
    write_all(file, mesh.triangles.size(), 14, [&](char* at, std::size_t i) {
        at = put(at, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            at = put(at, mesh.triangles[i][corner]);
        return put(at, mesh.triangle_parts[i]);
    });
    file.take_its_place();
}

} // namespace overt
