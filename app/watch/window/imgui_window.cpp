#include "app/watch/window/imgui_window.h"

#include <filesystem>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// Debian's package fonts-dejavu-core; without it ImGui's own font, which has ASCII only.
constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_px = 16.0f;

} // namespace

ImguiWindow::ImguiWindow(int width_px, int height_px, const char* title) {
    if (!glfwInit())
        throw GraphicsError("no window can be opened: is there a display? overt watch --terminal needs none");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    // It must not take the keyboard from the observer's screen.
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_FALSE);
    window_ = glfwCreateWindow(width_px, height_px, title, nullptr, nullptr);
    if (!window_) {
        glfwTerminate();
        throw GraphicsError("no window with OpenGL 3.3 can be opened: overt watch --terminal needs none");
    }
    make_current();
    glfwSwapInterval(0); // never waits for a refresh
    load_functions(glfwGetProcAddress, ContextKind::window, "GLFW");
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

ImguiWindow::~ImguiWindow() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void ImguiWindow::make_current() { glfwMakeContextCurrent(window_); }

bool ImguiWindow::is_closed() const { return glfwWindowShouldClose(window_) != 0; }

void ImguiWindow::draw(const std::function<void(float width, float height)>& lay_out) {
    glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    lay_out(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
    ImGui::Render();
    glfwGetFramebufferSize(window_, &size_px_.x, &size_px_.y);
    gl().BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl().Viewport(0, 0, size_px_.x, size_px_.y);
    gl().ClearColor(0.1f, 0.1f, 0.1f, 1.0f);
    gl().Clear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    gl().Finish();
}

void ImguiWindow::show(const std::function<void(glm::ivec2 window_px)>& draw_over) {
    draw_over(size_px_);
    glfwSwapBuffers(window_);
    gl().Finish();
}

} // namespace overt
