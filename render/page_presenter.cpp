#include "render/page_presenter.h"

#include <algorithm>

#include "experiment/error.h"
#include "experiment/parallel.h"
#include "render/text_layout.h"

namespace overt {

namespace {

/// 0.6 degrees: the disc of the fixation target (Thaler et al. 2013).
constexpr double fixation_target_deg = 0.6;

void blit(const GladGLContext& gl, const Framebuffer& from, const Framebuffer& to,
          glm::ivec2 origin_px) noexcept {
    const glm::ivec2 size = from.size_px();
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    gl.ReadBuffer(GL_COLOR_ATTACHMENT0);
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
    gl.BlitFramebuffer(0, 0, size.x, size.y, origin_px.x, origin_px.y, origin_px.x + size.x,
                       origin_px.y + size.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::span<const std::byte> bytes_of(const LinearImage& image) {
    return std::as_bytes(std::span(image.pixels));
}

} // namespace

PagePresenter::PagePresenter(const GlContext& context, DisplaySurface& surface, const FrameSource& frames,
                             const ScreenGeometry& geometry, const DisplaySettings& display,
                             const ScreenSettings& screens)
    : context_(&context), surface_(&surface), frames_(&frames), geometry_(geometry), display_(display),
      screens_(screens), encoder_(context, display.output, display.gamma),
      background_(context, geometry.screen_px, PixelFormat::rgba8),
      background_target_(context, {&background_}, false),
      canvas_(context, geometry.screen_px, PixelFormat::rgba8), canvas_target_(context, {&canvas_}, false),
      upload_(context, geometry.image_px, PixelFormat::rgba32f), page_target_(context) {
    Texture2D plain(context, geometry.screen_px, PixelFormat::rgba32f);
    LinearImage grey(geometry.screen_px);
    std::fill(grey.pixels.begin(), grey.pixels.end(),
              glm::vec4(glm::vec3(static_cast<float>(display.background)), 1.0f));
    plain.upload(bytes_of(grey));
    encoder_.encode(plain, background_target_);
    clear_canvas();
}

void PagePresenter::load_frames(const Condition& condition) {
    if (loaded_ == condition)
        return;
    loaded_.reset();
    page_of_frame_ = frames_->page_of_frame(condition);
    const int pages = 1 + *std::max_element(page_of_frame_.begin(), page_of_frame_.end());
    if (!store_ || store_->layers() < pages) {
        store_.reset();
        store_.emplace(*context_, geometry_.image_px, pages, PixelFormat::rgba8);
    }
    const float background = static_cast<float>(display_.background);
    // Decoded a few at a time on all processors, encoded one by one: never more than a few pages in linear
    // light at once.
    constexpr int at_once = 4;
    for (int first = 0; first < pages; first += at_once) {
        std::vector<LinearImage> pictures(static_cast<std::size_t>(std::min(at_once, pages - first)));
        parallel_for(static_cast<int>(pictures.size()), [&](int i) {
            LinearImage& picture = pictures[static_cast<std::size_t>(i)];
            picture = frames_->page(condition, first + i);
            for (glm::vec4& pixel : picture.pixels)
                pixel += glm::vec4(glm::vec3((1.0f - pixel.w) * background), 0.0f);
        });
        for (std::size_t i = 0; i < pictures.size(); ++i) {
            OVERT_EXPECTS(pictures[i].size_px == geometry_.image_px);
            upload_.upload(bytes_of(pictures[i]));
            page_target_.attach_layer(*store_, first + static_cast<int>(i));
            encoder_.encode(upload_, page_target_);
        }
    }
    context_->gl().Finish();
    throw_on_gl_error(*context_, "filling the frame store");
    loaded_ = condition;
}

void PagePresenter::clear_canvas() noexcept {
    blit(context_->gl(), background_target_, canvas_target_, {0, 0});
    canvas_holds_page_ = false;
}

void PagePresenter::draw_centred(const LinearImage& picture) {
    Texture2D linear(*context_, picture.size_px, PixelFormat::rgba32f);
    linear.upload(bytes_of(picture));
    Texture2D encoded(*context_, picture.size_px, PixelFormat::rgba8);
    const Framebuffer target(*context_, {&encoded}, false);
    encoder_.encode(linear, target);
    blit(context_->gl(), target, canvas_target_, centred_origin_px(geometry_.screen_px, picture.size_px));
}

FlipReport PagePresenter::show(const Screen& screen) {
    clear_canvas();
    const double px_per_deg = geometry_.px_per_deg_at_centre();
    const float background = static_cast<float>(display_.background),
                grey = static_cast<float>(screens_.text_grey);
    if (screen.kind == Screen::Kind::text && !screen.text.empty()) {
        TextStyle style;
        style.line_height_px = std::max(8, static_cast<int>(screens_.text_height_deg * px_per_deg));
        style.wrap_width_px = static_cast<int>(0.8 * geometry_.screen_px.x);
        style.grey = grey;
        style.background = background;
        draw_centred(draw_text(screen.text, style));
    } else if (screen.kind == Screen::Kind::drift_target) {
        draw_centred(draw_fixation_target(fixation_target_deg * px_per_deg, grey, background));
    }
    throw_on_gl_error(*context_, "drawing a screen");
    return surface_->present(canvas_target_);
}

FlipReport PagePresenter::flip(AnimationFrameIndex frame) noexcept {
    OVERT_EXPECTS(loaded_.has_value() && frame.value >= 0 &&
                  static_cast<std::size_t>(frame.value) < page_of_frame_.size());
    if (!canvas_holds_page_)
        clear_canvas();
    page_target_.attach_layer(*store_, page_of_frame_[static_cast<std::size_t>(frame.value)]);
    blit(context_->gl(), page_target_, canvas_target_, geometry_.image_origin_px);
    canvas_holds_page_ = true;
    return surface_->present(canvas_target_);
}

std::vector<std::byte> PagePresenter::read_canvas() const {
    std::vector<std::byte> bytes(static_cast<std::size_t>(geometry_.screen_px.x) *
                                 static_cast<std::size_t>(geometry_.screen_px.y) * 4);
    canvas_target_.bind();
    read_pixels(*context_, 0, {0, 0}, geometry_.screen_px, PixelFormat::rgba8, bytes);
    return bytes;
}

} // namespace overt
