#include "experiment/ports/event_kinds.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include <catch2/catch.hpp>

using namespace overt;
namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("the words of kinds of events differ, and are typed nowhere else where events are written or read",
          "[unit]") {
    const fs::path root = OVERT_SOURCE_DIR;
    const std::string list = text_of(root / "experiment/ports/event_kinds.h");
    std::map<std::string, int> words;
    const std::regex row("_event = \"([^\"]+)\"");
    for (std::sregex_iterator at(list.begin(), list.end(), row), end; at != end; ++at)
        CHECK(++words[(*at)[1]] == 1);
    CHECK(words.size() > 20);
    for (const char* folder : {"app", "devices", "experiment", "render"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path& file = entry.path();
            if ((file.extension() != ".cpp" && file.extension() != ".h") ||
                file.filename() == "event_kinds.h")
                continue;
            std::istringstream text(text_of(file));
            for (std::string line; std::getline(text, line);) {
                if (line.find("event({") == std::string::npos && line.find("note(") == std::string::npos &&
                    line.find("kind ==") == std::string::npos)
                    continue;
                for (const auto& [word, count] : words)
                    if (line.find('"' + word + '"') != std::string::npos)
                        FAIL_CHECK(file.string() << " retypes \"" << word << "\"");
            }
        }
    }
}
