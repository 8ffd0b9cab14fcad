#include "experiment/pictures/picture_file.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/memory_for.h"
#include "experiment/maps/coordinate_image_file.h"
#include "experiment/maps/triangle_map.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string big_endian(std::uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 255),
            static_cast<char>(value >> 8 & 255), static_cast<char>(value & 255)};
}

/// CRC-32 as PNG has it (ISO 3309).
std::uint32_t crc_of(const std::string& bytes) {
    std::uint32_t crc = ~0u;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

std::string chunk(const std::string& name, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + name + data +
           big_endian(crc_of(name + data));
}

/// A PNG of 16-bit RGBA whose header claims a size, and which holds nothing.
std::string png_claiming(std::uint32_t width, std::uint32_t height) {
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x10\x06\0\0\0", 5)) +
           chunk("IDAT", std::string("\x78\x9c\x03\0\0\0\0\1", 8)) + chunk("IEND", "");
}

std::string refusal(const std::filesystem::path& file) {
    try {
        const PictureFile picture(file, "map");
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

} // namespace

TEST_CASE("a picture whose header claims more than a picture can have is refused by name, before it is read",
          "[unit]") {
    const TemporaryFolder folder;
    const auto claiming = [&](std::uint32_t width, std::uint32_t height) {
        return folder.file("claim.png", png_claiming(width, height));
    };
    CHECK_THAT(refusal(claiming(60000, 60000)),
               Catch::Contains("claim.png") && Catch::Contains("60000 x 60000"));
    // 1 GiB of four channels of floats is 64 Mpx.
    CHECK_THAT(refusal(claiming(32768, 2049)), Catch::Contains("1024 MiB"));
    CHECK(refusal(claiming(32768, 2048)) == "none");
    CHECK(refusal(claiming(640, 480)) == "none");
    // All that read pictures ask here.
    claiming(60000, 60000);
    CHECK_THROWS_WITH(read_coordinate_image(folder.path() / "claim.png", {}),
                      Catch::Contains("60000 x 60000"));
    CHECK_THROWS_WITH(read_map_description(folder.path() / "claim.png"), Catch::Contains("60000 x 60000"));
    CHECK_THROWS_WITH(read_triangle_map(folder.path() / "claim.png"), Catch::Contains("60000 x 60000"));
    // A header that is sound with nothing behind it is told, too.
    claiming(64, 64);
    CHECK_THROWS_WITH(read_coordinate_image(folder.path() / "claim.png", {}), Catch::Contains("claim.png"));
}

TEST_CASE("memory that runs out names the file that was being read", "[unit]") {
    CHECK_THROWS_WITH(with_memory_for("statue.ply", []() -> int { throw std::bad_alloc(); }),
                      Catch::StartsWith("statue.ply: the memory"));
    CHECK_THROWS_WITH(with_memory_for("outer.toml", []() -> int { throw InputError("inner.ply: no mesh"); }),
                      "inner.ply: no mesh");
    CHECK(with_memory_for("sound.ply", [] { return 7; }) == 7);
}
