/// Who may include whom. Arrows point downwards only: app on render and devices, these on experiment, and
/// within experiment the record and the analysis on the words.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

/// What a file of `folder` may include: folders of this project, whole with `…/*`, and which outside headers
/// it may not.
struct Layer {
    std::string folder;
    std::string may_include;
    std::string outside_it;
};

const std::string opengl = "^(GL/|GLES|GLFW/|EGL/|KHR/|glad/|X11/)", usb = "^(libusb|hidapi)",
                  drawing = "^(OpenImageIO/|pango/|cairo)", database = "^(SQLiteCpp/|sqlite3)",
                  all_of_these = opengl + "|" + usb + "|" + drawing + "|" + database;

/// The first that holds a file counts.
const std::vector<Layer> layers{
    {"experiment/scene/", "^experiment/([^/]+|scene/.*)$", all_of_these},
    {"experiment/colour/", "^experiment/([^/]+|colour/.*)$", all_of_these},
    {"experiment/timing/", "^experiment/([^/]+|timing/.*)$", all_of_these},
    // The checks and the report of a protocol reckon with its design, and a design is one of a protocol.
    {"experiment/design/", "^experiment/([^/]+|(protocol|design)/.*)$", all_of_these},
    // A protocol names metals and the sculptures that are shipped.
    {"experiment/protocol/",
     "^experiment/([^/]+|(colour|timing|protocol|design)/.*|scene/(metal_table|sculptures/sculptures)\\.h)$",
     all_of_these},
    {"experiment/analysis/", "^experiment/([^/]+|(scene|timing|analysis)/.*)$",
     opengl + "|" + usb + "|" + database},
    // A recorded session is read without the protocol that it came from.
    {"experiment/record/", "^experiment/([^/]+|(scene|timing|analysis|record)/.*)$",
     opengl + "|" + usb + "|" + drawing},
    {"experiment/audio/", "^experiment/([^/]+|audio/.*)$", all_of_these},
    {"experiment/session/", "^experiment/([^/]+|(timing|protocol|design|session)/.*)$", all_of_these},
    // These three are rules about protocols, the rest of the folder is words that everybody uses.
    {"experiment/session.", "^experiment/([^/]+|(timing|protocol|design|session)/.*)$",
     opengl + "|" + usb + "|" + drawing},
    {"experiment/schedule.", "^experiment/([^/]+|(protocol|design)/.*)$", opengl + "|" + usb + "|" + drawing},
    {"experiment/sculpture.", "^experiment/([^/]+|(protocol|scene)/.*)$", opengl + "|" + usb + "|" + drawing},
    {"experiment/", "^experiment/[^/]+$", all_of_these},
    {"render/", "^(experiment/([^/]+|(colour|scene|timing|protocol|analysis)/.*)|render/.*)$",
     usb + "|" + database},
    {"devices/", "^(experiment/([^/]+|(audio|colour|scene|timing|protocol|analysis)/.*)|devices/.*)$",
     opengl + "|" + drawing + "|" + database},
    {"app/", "^(experiment|render|devices|app)/.*$", "^$"},
};

/// The project's own words do not build on its rules.
const std::regex rules("^experiment/(session|schedule|sculpture)\\.h$");

/// The includes of a file that point the wrong way.
std::vector<std::string> wrong_includes(const std::string& file, const std::string& text) {
    const auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& candidate) {
        return file.starts_with(candidate.folder);
    });
    if (layer == layers.end())
        return {"a file in no known folder"};
    const std::regex include(R"re(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])re", std::regex::multiline);
    std::vector<std::string> wrong;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), include);
         match != std::sregex_iterator(); ++match) {
        const std::string name = (*match)[2];
        const bool ours = (*match)[1] == "\"";
        // Names without a folder are made at build time.
        const bool generated = ours && name.find('/') == std::string::npos;
        const bool upwards = ours && !generated && !std::regex_search(name, std::regex(layer->may_include));
        const bool foreign = !ours && std::regex_search(name, std::regex(layer->outside_it));
        const bool word_on_rule = layer->folder == "experiment/" && std::regex_search(name, rules);
        if (upwards || foreign || word_on_rule)
            wrong.push_back(file + " includes " + name);
    }
    return wrong;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("no include points the wrong way", "[unit]") {
    const fs::path root(OVERT_SOURCE_DIR);
    std::set<std::string> folders;
    int files = 0;
    for (const char* const top : {"experiment", "render", "devices", "app"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".h" && extension != ".cpp")
                continue;
            const std::string file = entry.path().lexically_relative(root).generic_string();
            const std::vector<std::string> wrong = wrong_includes(file, text_of(entry.path()));
            CAPTURE(file);
            CHECK(wrong == std::vector<std::string>{});
            ++files;
        }
    }
    CHECK(files > 100);
}

TEST_CASE("an include that points the wrong way is found", "[unit]") {
    const auto is_refused = [](const std::string& file, const std::string& line) {
        return wrong_includes(file, "#pragma once\n#include <vector>\n" + line + "\n").size() == 1;
    };
    CHECK(is_refused("experiment/session.cpp", "#include \"render/gl_context.h\""));
    CHECK(is_refused("experiment/gaze.h", "#include \"devices/clocks.h\""));
    CHECK(is_refused("experiment/gaze.h", "#include \"experiment/record/sql.h\""));
    CHECK(is_refused("experiment/gaze.h", "#include \"experiment/session.h\""));
    CHECK(is_refused("experiment/scene/mesh.h", "  #  include <GLFW/glfw3.h>"));
    CHECK(is_refused("experiment/analysis/triangle_map.cpp", "#include <glad/gl.h>"));
    CHECK(
        is_refused("experiment/analysis/flip_history.h", "#include \"experiment/record/session_record.h\""));
    CHECK(is_refused("experiment/record/sql.cpp", "#include \"experiment/protocol/protocol.h\""));
    CHECK(is_refused("render/mesh_buffers.cpp", "#include \"devices/clocks.h\""));
    CHECK(is_refused("render/mesh_buffers.cpp", "#include \"app/rig.h\""));
    CHECK(is_refused("devices/clocks.h", "#include \"render/gl_context.h\""));
    CHECK(is_refused("devices/clocks.h", "#include <EGL/egl.h>"));
    CHECK(is_refused("devices/clocks.h", "#include \"tests/support/figures.h\""));
    CHECK_FALSE(is_refused("app/rig.h", "#include \"devices/clocks.h\""));
    CHECK_FALSE(is_refused("render/window_context.cpp", "#include <GLFW/glfw3.h>"));
}
