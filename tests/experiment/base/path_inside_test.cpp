/// What lies in a folder and what does not, on the disk.
#include "experiment/base/path_inside.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "experiment/base/error.h"
#include "experiment/base/partial_directory.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
namespace fs = std::filesystem;
using Catch::Matchers::Contains;

TEST_CASE("links, pipes and names that lead out are no files of a folder", "[unit]") {
    const test::TemporaryFolder root;
    const fs::path folder = root.path() / "session";
    fs::create_directories(folder / "maps/bust");
    root.file("secret.txt", "secret");
    root.file("session/maps/bust/a.exr", "a");
    fs::create_symlink(root.path() / "secret.txt", folder / "maps/link.exr");
    fs::create_directory_symlink(root.path(), folder / "out");
    REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK(why_no_file_inside(folder, "maps/bust/a.exr").empty());
    CHECK(why_no_file_inside(folder, "maps/./bust/../bust/a.exr").empty());
    CHECK_THAT(why_no_file_inside(folder, "maps/link.exr"), Contains("is a link"));
    CHECK_THAT(why_no_file_inside(folder, "out/secret.txt"), Contains("behind one"));
    CHECK(why_no_file_inside(folder, "pipe") == "is no file");
    CHECK(why_no_file_inside(folder, "maps") == "is no file");
    CHECK(why_no_file_inside(folder, "maps/b.exr") == "is missing");
    CHECK(why_no_file_inside(folder, "../secret.txt") == "leads out of the folder");
    CHECK(why_no_file_inside(folder, (root.path() / "secret.txt").string()) == "leads out of the folder");
    CHECK_THROWS_WITH(require_file_inside(folder, "pipe"), Contains("pipe: is no file"));
    CHECK(require_file_inside(folder, "maps/bust/a.exr") == folder / "maps/bust/a.exr");
    // The folder itself is where the user says.
    fs::create_directory_symlink(folder, root.path() / "here");
    CHECK(is_file_inside(root.path() / "here", "maps/bust/a.exr"));
}

TEST_CASE("a folder in the making has what the umask leaves of the rights around it", "[unit]") {
    const test::TemporaryFolder root;
    const ::mode_t before = ::umask(0022);
    const auto made_below = [&](::mode_t mode) {
        const fs::path around = root.path() / fmt::format("{:o}", mode);
        fs::create_directories(around);
        REQUIRE(::chmod(around.c_str(), mode) == 0);
        const PartialDirectory made(around / "export");
        return static_cast<unsigned>(fs::status(made.path()).permissions());
    };
    CHECK(made_below(0777) == 0755);
    CHECK(made_below(0750) == 0750);
    CHECK(made_below(0700) == 0700);
    ::umask(0077);
    CHECK(made_below(0775) == 0700);
    ::umask(before);
}

TEST_CASE("what a killed program was making goes with the next of that name, and nothing else does",
          "[unit]") {
    const test::TemporaryFolder root;
    char host[65] = "";
    ::gethostname(host, sizeof host - 1);
    const auto left = [&](const std::string& name) {
        fs::create_directories(root.path() / name / "deep");
        return root.path() / name;
    };
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(0);
    ::waitpid(child, nullptr, 0);
    const fs::path dead = left(fmt::format(".export.partial-{}-{}-AbCdEf", host, child));
    const fs::path of_another = left(fmt::format(".exports.partial-{}-{}-AbCdEf", host, child));
    const fs::path elsewhere = left(fmt::format(".export.partial-other{}-{}-AbCdEf", host, child));
    const fs::path living = left(fmt::format(".export.partial-{}-{}-AbCdEf", host, ::getppid()));
    const fs::path alike = left(".export.partial-mine");
    const PartialDirectory made(root.path() / "export");
    CHECK_FALSE(fs::exists(dead));
    for (const fs::path& stays : {of_another, elsewhere, living, alike})
        CHECK(fs::exists(stays));
    CHECK(
        made.path().filename().string().starts_with(fmt::format(".export.partial-{}-{}-", host, ::getpid())));
}
