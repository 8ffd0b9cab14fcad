#include "app/watch/window/watch_window.h"

#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "app/watch/watched_session.h"
#include "app/watch/window/watch_panels.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr int first_width = 1280, first_height = 800;
/// Debian's package fonts-dejavu-core; without it ImGui's own font, which has ASCII only.
constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_px = 16.0f;
/// A view need not be as fast as a display.
constexpr std::chrono::milliseconds between_frames{33};

/// GLFW, a window with a context, and Dear ImGui in it.
class ImguiWindow {
  public:
    ImguiWindow() {
        if (!glfwInit())
            throw GraphicsError(
                "no window can be opened: is there a display? overt watch --terminal needs none");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        // It must not take the keyboard from the observer's screen.
        glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
        window_ = glfwCreateWindow(first_width, first_height, "overt: the operator's view", nullptr, nullptr);
        if (!window_) {
            glfwTerminate();
            throw GraphicsError("no window with OpenGL 3.3 can be opened: overt watch --terminal needs none");
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(0); // never waits for a refresh: the pace is between_frames
        gladLoadGLContext(&gl, glfwGetProcAddress);
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        if (std::filesystem::exists(font_file)) {
            // Latin, Greek and Cyrillic, and marks such as dashes.
            static constexpr ImWchar ranges[] = {0x20, 0x24F, 0x370, 0x52F, 0x2010, 0x2044, 0};
            io.Fonts->AddFontFromFileTTF(font_file, font_px, nullptr, ranges);
        }
        ImGui::StyleColorsDark();
        ImGui_ImplGlfw_InitForOpenGL(window_, true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
    }
    ~ImguiWindow() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
        glfwDestroyWindow(window_);
        glfwTerminate();
    }
    ImguiWindow(const ImguiWindow&) = delete;
    ImguiWindow& operator=(const ImguiWindow&) = delete;

    bool is_closed() const { return glfwWindowShouldClose(window_) != 0; }

    template <class Draw> void show(const Draw& draw) {
        glfwPollEvents();
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        draw(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
        ImGui::Render();
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        gl.Viewport(0, 0, width, height);
        gl.ClearColor(0.1f, 0.1f, 0.1f, 1.0f);
        gl.Clear(GL_COLOR_BUFFER_BIT);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        glfwSwapBuffers(window_);
    }

    GladGLContext gl{};

  private:
    GLFWwindow* window_ = nullptr;
};

/// The stimulus as a texture, renewed when it changes.
class PictureTexture {
  public:
    explicit PictureTexture(const GladGLContext& gl) : gl_(gl) {
        gl_.GenTextures(1, &texture_);
        gl_.BindTexture(GL_TEXTURE_2D, texture_);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    ~PictureTexture() { gl_.DeleteTextures(1, &texture_); }
    PictureTexture(const PictureTexture&) = delete;
    PictureTexture& operator=(const PictureTexture&) = delete;

    /// As ImGui names it; null for a picture without squares.
    void* of(const ViewedPicture& picture) {
        if (picture.lightness.empty())
            return nullptr;
        if (picture.lightness != shown_) {
            shown_ = picture.lightness;
            std::vector<unsigned char> bytes;
            for (const float light : shown_) {
                const auto byte = static_cast<unsigned char>(255.0f * light + 0.5f);
                bytes.insert(bytes.end(), {byte, byte, byte, 255});
            }
            gl_.BindTexture(GL_TEXTURE_2D, texture_);
            gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, picture.width, picture.height, 0, GL_RGBA,
                           GL_UNSIGNED_BYTE, bytes.data());
        }
        return reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture_));
    }

  private:
    const GladGLContext& gl_;
    GLuint texture_ = 0;
    std::vector<float> shown_;
};

} // namespace

int watch_in_window(const std::filesystem::path& socket) {
    OperatorClient client(socket);
    WatchedSession session(client);
    ImguiWindow window;
    PictureTexture texture(window.gl);
    WatchPanels panels(client);
    while (!window.is_closed()) {
        const auto next = std::chrono::steady_clock::now() + between_frames;
        session.read(std::chrono::milliseconds(0));
        const ViewText text = session.text();
        window.show(
            [&](float width, float height) { panels.draw(text, texture.of(text.picture), width, height); });
        std::this_thread::sleep_until(next);
    }
    return 0;
}

} // namespace overt
