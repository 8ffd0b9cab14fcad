#include "experiment/pictures/whole_exr.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace overt {
namespace {

constexpr std::uint32_t exr_magic = 20000630, tiled = 0x200, deep = 0x800, of_several_parts = 0x1000;

/// Rows of a block by the number of its compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
constexpr int rows_of_block[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

/// Reads little-endian numbers and texts; what is not there makes all further answers worthless.
class ExrBytes {
  public:
    explicit ExrBytes(std::istream& stream) : stream_(stream) {}

    template <class Number> Number number() {
        Number value{};
        stream_.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    }
    /// Up to its end; texts of a header are short.
    std::string text() {
        std::string text;
        for (char c = 0; text.size() < 256 && stream_.get(c) && c != '\0';)
            text += c;
        return text;
    }
    void skip(std::int64_t bytes) { stream_.seekg(bytes, std::ios::cur); }
    void go_to(std::uint64_t place) { stream_.seekg(static_cast<std::streamoff>(place)); }
    bool good() const { return stream_.good(); }

  private:
    std::istream& stream_;
};

} // namespace

bool is_whole_exr(const std::filesystem::path& file) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream)
        return false;
    ExrBytes bytes(stream);
    if (bytes.number<std::uint32_t>() != exr_magic)
        return false;
    if (bytes.number<std::uint32_t>() & (tiled | deep | of_several_parts))
        return bytes.good();
    std::size_t compression = std::size(rows_of_block);
    std::int32_t window[4] = {0, 0, -1, -1};
    for (std::string name = bytes.text(); !name.empty(); name = bytes.text()) {
        bytes.text(); // its type
        const auto length = bytes.number<std::int32_t>();
        if (!bytes.good() || length < 0 || static_cast<std::uint64_t>(length) > size)
            return false;
        if (name == "compression" && length == 1) {
            compression = bytes.number<std::uint8_t>();
        } else if (name == "dataWindow" && length == sizeof window) {
            for (std::int32_t& side : window)
                side = bytes.number<std::int32_t>();
        } else {
            bytes.skip(length);
        }
    }
    const std::int64_t rows = std::int64_t{window[3]} - window[1] + 1;
    if (!bytes.good() || compression >= std::size(rows_of_block) || rows <= 0 || rows > 1 << 24)
        return false;
    const std::int64_t blocks = (rows + rows_of_block[compression] - 1) / rows_of_block[compression];
    std::uint64_t last = 0;
    for (std::int64_t block = 0; block < blocks; ++block) {
        const auto offset = bytes.number<std::uint64_t>();
        if (!bytes.good() || offset == 0) // a block that was never written
            return false;
        last = std::max(last, offset);
    }
    bytes.go_to(last);
    bytes.number<std::int32_t>(); // its first row
    const auto length = bytes.number<std::int32_t>();
    return bytes.good() && length >= 0 && last + 8 + static_cast<std::uint64_t>(length) <= size;
}

} // namespace overt
