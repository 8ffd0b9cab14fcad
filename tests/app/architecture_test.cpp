/// Who may include whom. A room is a folder with a target of its own; its CMakeLists.txt says which rooms it
/// uses, and a room can only use those declared before it. What the linker cannot see is looked for here:
/// headers of rooms that are not used, and of libraries that a part of the program is to know nothing of.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

/// Each room with all that it uses, directly or through others, and itself.
using Rooms = std::map<std::string, std::set<std::string>>;

/// From lines "room: used used", in the order in which they were declared.
Rooms read_rooms(std::istream& stream) {
    Rooms rooms;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::string room, used;
        if (!(words >> room))
            continue;
        room.pop_back();
        std::set<std::string>& reach = rooms[room];
        reach.insert(room);
        while (words >> used)
            reach.insert(rooms.at(used).begin(), rooms.at(used).end());
    }
    return rooms;
}

Rooms rooms_of_the_program() {
    std::ifstream stream(OVERT_ROOMS_FILE);
    return read_rooms(stream);
}

/// Headers of libraries that a part of the program does not know.
const std::string opengl = "^(GL/|GLES|GLFW/|EGL/|KHR/|glad/|X11/|xcb/)", usb = "^(libusb|hidapi)",
                  drawing = "^(OpenImageIO/|pango/|cairo)", database = "^(SQLiteCpp/|sqlite3)";
const std::vector<std::pair<std::string, std::string>> unknown_to{
    {"experiment/pictures/module", opengl + "|" + usb + "|" + database},
    {"experiment/record", opengl + "|" + usb + "|" + drawing},
    {"experiment", opengl + "|" + usb + "|" + drawing + "|" + database},
    {"render", usb + "|" + database},
    {"devices/pointer", usb + "|" + drawing + "|" + database}, // which is the X server's
    {"devices", opengl + "|" + drawing + "|" + database},
    {"app", "^$"},
};

bool is_in(const std::string& file, const std::string& folder) { return file.starts_with(folder + "/"); }

/// The includes of a file that its room must not have.
std::vector<std::string> wrong_includes(const Rooms& rooms, const std::string& file,
                                        const std::string& text) {
    const auto room = rooms.find(fs::path(file).parent_path().generic_string());
    if (room == rooms.end())
        return {file + " is in no room"};
    const auto unknown = std::find_if(unknown_to.begin(), unknown_to.end(),
                                      [&](const auto& rule) { return is_in(file, rule.first); });
    const std::regex include(R"re(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])re", std::regex::multiline);
    const std::regex unknown_header(unknown->second);
    std::vector<std::string> wrong;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), include);
         match != std::sregex_iterator(); ++match) {
        const std::string name = (*match)[2];
        const bool ours = (*match)[1] == "\"";
        // Names without a folder are made at build time.
        const bool is_used = !ours || name.find('/') == std::string::npos ||
                             room->second.contains(fs::path(name).parent_path().generic_string());
        if (!is_used || (!ours && std::regex_search(name, unknown_header)))
            wrong.push_back(file + " includes " + name);
    }
    return wrong;
}

/// The types that a header defines outside of others, with the namespaces that they are in. Namespaces are
/// not indented here, and what is within a type is.
std::vector<std::string> types_defined_in(const std::string& text) {
    const std::regex line(
        R"re(^(?:namespace ([\w:]+) \{|(\} // namespace)|)re"
        R"re((?:template <.*> )?(?:struct|class|enum class|enum|union) (?:alignas\(.*\) )?(\w+)\b(?!::| *;)|)re"
        R"re(using (\w+) =))re",
        std::regex::multiline);
    std::vector<std::string> spaces, types;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), line); match != std::sregex_iterator();
         ++match) {
        if ((*match)[1].matched)
            spaces.push_back((*match)[1].str() + "::");
        else if ((*match)[2].matched)
            spaces.pop_back();
        else
            types.push_back(std::accumulate(spaces.begin(), spaces.end(), std::string()) +
                            ((*match)[3].matched ? (*match)[3] : (*match)[4]).str());
    }
    return types;
}

std::string source_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("no include points the wrong way", "[unit]") {
    const Rooms rooms = rooms_of_the_program();
    const fs::path root(OVERT_SOURCE_DIR);
    std::set<std::string> seen;
    for (const char* const top : {"experiment", "render", "devices", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp")
                continue;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            const std::vector<std::string> wrong = wrong_includes(rooms, file, source_of(entry.path()));
            CAPTURE(file);
            CHECK(wrong == std::vector<std::string>{});
            seen.insert(fs::path(file).parent_path().generic_string());
        }
    }
    CHECK(seen.size() == rooms.size()); // each room has files, each folder with files is a room
}

TEST_CASE("render/ and devices/ never see each other, and nobody sees app/", "[unit]") {
    for (const auto& [room, reach] : rooms_of_the_program()) {
        for (const std::string& used : reach) {
            CAPTURE(room, used);
            CHECK_FALSE((room.starts_with("render") && used.starts_with("devices")));
            CHECK_FALSE((room.starts_with("devices") && used.starts_with("render")));
            CHECK_FALSE((!room.starts_with("app") && used.starts_with("app")));
            if (room.starts_with("experiment"))
                CHECK(used.starts_with("experiment"));
        }
    }
}

// Two types of one name in one program share what the linker makes for them, such as a vector of them.
TEST_CASE("no two headers of the program define a type of the same name", "[unit]") {
    const fs::path root(OVERT_SOURCE_DIR);
    std::map<std::string, std::string> header_of;
    for (const char* const top : {"experiment", "render", "devices", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            if (entry.path().extension() != ".h")
                continue;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            for (const std::string& type : types_defined_in(source_of(entry.path()))) {
                CAPTURE(type, file);
                CHECK(header_of.try_emplace(type, file).first->second == file);
            }
        }
    }
    CHECK(header_of.size() > 500);
    CHECK(header_of.contains("overt::Error"));
    CHECK(
        types_defined_in("namespace a {\nstruct B {\n    struct Inner {};\n};\nclass Later;\nnamespace c {\n"
                         "template <class T> class D final : public B {};\n} // namespace c\n"
                         "enum class E : int { one };\nusing F = int;\n} // namespace a\n") ==
        std::vector<std::string>{"a::B", "a::c::D", "a::E", "a::F"});
}

TEST_CASE("an include that points the wrong way is found", "[unit]") {
    const Rooms rooms = rooms_of_the_program();
    const auto is_refused = [&](const std::string& file, const std::string& line) {
        return wrong_includes(rooms, file, "#pragma once\n#include <vector>\n" + line + "\n").size() == 1;
    };
    CHECK(is_refused("experiment/gaze.h", "#include \"devices/host/clocks.h\""));
    CHECK(is_refused("experiment/gaze.h", "#include \"experiment/record/sql.h\""));
    CHECK(is_refused("experiment/gaze.h", "#include \"experiment/session/session.h\""));
    CHECK(is_refused("experiment/protocol/protocol.h", "#include \"experiment/checks/checked_protocol.h\""));
    CHECK(is_refused("experiment/record/sql.cpp", "#include \"experiment/protocol/protocol.h\""));
    CHECK(is_refused("experiment/scene/mesh.h", "  #  include <GLFW/glfw3.h>"));
    CHECK(is_refused("experiment/maps/triangle_map.cpp", "#include <glad/gl.h>"));
    CHECK(is_refused("experiment/record/read/session_record.cpp", "#include <libusb.h>"));
    CHECK(is_refused("render/gl/gl_context.cpp", "#include \"render/window/window_context.h\""));
    CHECK(is_refused("render/stimulus/mesh_buffers.cpp", "#include \"app/rig/rig.h\""));
    CHECK(is_refused("devices/host/clocks.h", "#include <EGL/egl.h>"));
    CHECK(is_refused("devices/host/clocks.h", "#include \"tests/support/figures.h\""));
    CHECK(is_refused("app/session/rig.h", "#include \"app/bench/bench_command.h\""));
    CHECK(is_refused("experiment/attic/old.h", ""));
    CHECK_FALSE(is_refused("app/rig/rig.h", "#include \"devices/host/clocks.h\""));
    CHECK_FALSE(is_refused("render/window/window_context.cpp", "#include <GLFW/glfw3.h>"));
}

TEST_CASE("documents name only files that there are", "[unit]") {
    const fs::path root = fs::path(OVERT_SOURCE_DIR);
    std::vector<fs::path> documents;
    for (const fs::path& folder : {root, root / "docs", root / "assets", root / "tests"})
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".md")
                documents.push_back(entry.path());
    CHECK(documents.size() > 10);
    const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
    for (const fs::path& document : documents) {
        std::ifstream stream(document);
        const std::string text{std::istreambuf_iterator<char>(stream), {}};
        for (auto found = std::sregex_iterator(text.begin(), text.end(), link);
             found != std::sregex_iterator(); ++found) {
            CAPTURE(document, (*found)[1].str());
            CHECK(fs::exists(document.parent_path() / (*found)[1].str()));
        }
    }
}
