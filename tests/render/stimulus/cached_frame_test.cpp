/// Frames of the cache say whose they are and what their pixels are.
#include "render/stimulus/cached_frame.h"

#include <utility>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"
#include "experiment/pictures/whole_exr.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace {

LinearImage picture(float first) {
    LinearImage image({37, 41});
    float value = first;
    for (glm::vec4& pixel : image.pixels) {
        pixel = glm::vec4(value, 0.1f * value, -value, 0.7f);
        value = value * 1.0013f + 1e-3f;
    }
    return image;
}

const FrameIdentity gold{"key of gold", {.angle = {-12.5}}}, silver{"key of silver", {.angle = {-12.5}}},
    turned{"key of gold", {.angle = {0.1}}};

fs::path written(const test::TemporaryFolder& folder, const std::string& name, const FrameIdentity& identity,
                 float first) {
    fs::path file = folder.path() / name;
    write_cached_frame(file, picture(first), identity,
                       {{"overt:angle_deg", fmt::format("{}", identity.object.angle.value)}});
    return file;
}

} // namespace

TEST_CASE("the hash of pixels is the same before a frame is written and after it was read", "[unit]") {
    const test::TemporaryFolder folder;
    const fs::path file = written(folder, "a.exr", gold, 0.3f);
    LinearImage read;
    read_cached_frame(file, gold, read);
    CHECK(hash_of_pixels(read) == hash_of_pixels(picture(0.3f)));
    CHECK(pixels_hash_of(file, gold) == hash_of_pixels(picture(0.3f)));
    LinearImage changed = picture(0.3f);
    changed.pixels[700].y += 1e-3f;
    CHECK(hash_of_pixels(changed) != hash_of_pixels(picture(0.3f)));
    LinearImage narrow = picture(0.3f);
    std::swap(narrow.size_px.x, narrow.size_px.y);
    CHECK(hash_of_pixels(narrow) != hash_of_pixels(picture(0.3f)));
}

TEST_CASE("frames that were swapped, or are of something else, are no frames", "[unit]") {
    const test::TemporaryFolder folder;
    const fs::path file = written(folder, "a.exr", gold, 0.3f);
    CHECK_FALSE(why_no_frame(file, gold, true));
    CHECK(why_no_frame(file, silver, true) == "is a frame of something else");
    CHECK(why_no_frame(file, turned, true) == "is the frame at -12.5 degrees");
    CHECK(why_no_frame(folder.path() / "none.exr", gold, true) == "is not whole");
    LinearImage read;
    CHECK_THROWS_WITH(read_cached_frame(file, turned, read), Contains("a.exr") && Contains("remove it"));
}

TEST_CASE("a frame whose pixels were changed is not read", "[unit]") {
    const test::TemporaryFolder folder;
    const fs::path file = written(folder, "a.exr", gold, 0.3f), other = folder.path() / "b.exr";
    // As somebody would forge it who knows the format and forgets the hash.
    const PictureHeader header = PictureFile(file, "frame").header();
    ImageAttributes attributes;
    for (const auto& [name, value] : header.attributes)
        if (const auto* text = std::get_if<std::string>(&value); text && name.starts_with("overt:"))
            attributes.emplace_back(name, *text);
    write_linear_exr(other, picture(0.31f), attributes);
    CHECK_FALSE(why_no_frame(other, gold, true));
    LinearImage read;
    CHECK_THROWS_WITH(read_cached_frame(other, gold, read), Contains("has other pixels"));
}

TEST_CASE("a frame of an earlier program gets its hash when it is first asked for", "[unit]") {
    const test::TemporaryFolder folder;
    const fs::path file = folder.path() / "a.exr";
    write_linear_exr(file, picture(0.3f),
                     {{"overt:angle_deg", "-12.5"}, {"overt:renderer", "path tracer 7"}});
    CHECK_FALSE(why_no_frame(file, gold, false));
    CHECK(why_no_frame(file, gold, true) == "does not say what it is");
    CHECK(pixels_hash_of(file, gold) == hash_of_pixels(picture(0.3f)));
    CHECK_FALSE(why_no_frame(file, gold, true));
    const PictureHeader header = PictureFile(file, "frame").header();
    CHECK(header.text("overt:renderer") == "path tracer 7");
    CHECK(header.text("overt:pixels_sha256") == hash_of_pixels(picture(0.3f)));
}

TEST_CASE("a file of OpenEXR that was cut off anywhere is not whole", "[unit]") {
    const test::TemporaryFolder folder;
    const fs::path file = written(folder, "a.exr", gold, 0.3f);
    CHECK(is_whole_exr(file));
    const auto bytes = static_cast<std::int64_t>(fs::file_size(file));
    for (const std::int64_t left :
         {bytes - 1, bytes / 2, std::int64_t{300}, std::int64_t{5}, std::int64_t{0}}) {
        const fs::path cut = folder.path() / "cut.exr";
        fs::copy_file(file, cut, fs::copy_options::overwrite_existing);
        fs::resize_file(cut, static_cast<std::uintmax_t>(left));
        INFO(left << " of " << bytes);
        CHECK_FALSE(is_whole_exr(cut));
        CHECK(why_no_frame(cut, gold, true) == "is not whole");
    }
    CHECK_FALSE(
        is_whole_exr(folder.file("text.exr", "no picture at all, but longer than a header of a few bytes")));
}
