#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "experiment/pictures/picture_library.h"

namespace overt {

namespace {

using OIIO::TypeDesc;

constexpr TypeDesc double_triple(TypeDesc::DOUBLE, TypeDesc::VEC3);

constexpr std::pair<PixelType, TypeDesc::BASETYPE> types[] = {
    {PixelType::bits8, TypeDesc::UINT8},   {PixelType::bits16, TypeDesc::UINT16},
    {PixelType::bits32, TypeDesc::UINT32}, {PixelType::float16, TypeDesc::HALF},
    {PixelType::float32, TypeDesc::FLOAT}, {PixelType::other, TypeDesc::UNKNOWN}};

TypeDesc type_desc(PixelType type) {
    return std::ranges::find(types, type, [](const auto& row) { return row.first; })->second;
}

PixelType value_type(const TypeDesc& type) {
    const auto* const row = std::ranges::find(types, TypeDesc::BASETYPE(type.basetype),
                                              [](const auto& pair) { return pair.second; });
    return row == std::end(types) ? PixelType::other : row->first;
}

void read_attribute(const OIIO::ParamValue& attribute, PictureHeader& into) {
    const std::string name = attribute.name().string();
    const TypeDesc type = attribute.type();
    if (type == TypeDesc(TypeDesc::STRING)) {
        into.attributes.emplace_back(name, attribute.get_string());
    } else if (type == TypeDesc(TypeDesc::INT)) {
        into.attributes.emplace_back(name, *static_cast<const int*>(attribute.data()));
    } else if (type == TypeDesc(TypeDesc::DOUBLE)) {
        into.attributes.emplace_back(name, *static_cast<const double*>(attribute.data()));
    } else if (type.basetype == TypeDesc::DOUBLE && type.basevalues() == 3) {
        // Whether it calls itself a vector or three numbers does not matter.
        const auto* const values = static_cast<const double*>(attribute.data());
        into.attributes.emplace_back(name, glm::dvec3(values[0], values[1], values[2]));
    }
}

void write_attribute(OIIO::ImageSpec& spec, const std::string& name, const PictureAttribute& attribute) {
    if (const auto* const number = std::get_if<int>(&attribute))
        spec.attribute(name, *number);
    else if (const auto* const real = std::get_if<double>(&attribute))
        spec.attribute(name, TypeDesc::DOUBLE, real);
    else if (const auto* const triple = std::get_if<glm::dvec3>(&attribute))
        spec.attribute(name, double_triple, &triple->x);
    else
        spec.attribute(name, std::get<std::string>(attribute));
}

PictureHeader header_of(const OIIO::ImageSpec& spec) {
    PictureHeader header{
        {spec.width, spec.height}, spec.channelnames, value_type(spec.format), spec.alpha_channel};
    header.channels.resize(static_cast<std::size_t>(std::max(spec.nchannels, 0)));
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        read_attribute(attribute, header);
    header.type_name = spec.format.c_str();
    header.tile_px = {spec.tile_width, spec.tile_height};
    header.channels_differ = !spec.channelformats.empty();
    header.is_deep_or_volume = spec.deep || spec.depth > 1;
    if (const OIIO::ParamValue* const colours = spec.find_attribute("chromaticities");
        colours && colours->type().basetype == TypeDesc::FLOAT && colours->type().basevalues() == 8)
        std::copy_n(static_cast<const float*>(colours->data()), 8, header.primaries.emplace().begin());
    return header;
}

/// Where the pixels of a file belong in the picture. The picture is the display window of an OpenEXR file,
/// black outside the data window, and is turned upright where a file says how a camera was held (EXIF's
/// numbers 1 to 8).
class Layout {
  public:
    Layout(const OIIO::ImageSpec& spec, bool has_windows, bool as_stored)
        : stored_px_(spec.width, spec.height), window_px_(stored_px_),
          orientation_(as_stored ? 1 : std::clamp(spec.get_int_attribute("Orientation", 1), 1, 8)) {
        if (has_windows) {
            window_px_ = {spec.full_width, spec.full_height};
            stored_at_ = {spec.x - spec.full_x, spec.y - spec.full_y};
        }
    }
    bool is_plain() const {
        return orientation_ == 1 && window_px_ == stored_px_ && stored_at_ == glm::ivec2(0);
    }
    glm::ivec2 stored_px() const { return stored_px_; }
    glm::ivec2 picture_px() const {
        return orientation_ < 5 ? window_px_ : glm::ivec2(window_px_.y, window_px_.x);
    }
    /// The stored pixel of a pixel of the picture; it may lie outside.
    glm::ivec2 stored_pixel(glm::ivec2 p) const {
        const glm::ivec2 last = window_px_ - 1;
        const glm::ivec2 in_window = [&]() -> glm::ivec2 {
            switch (orientation_) {
            case 2:
                return {last.x - p.x, p.y};
            case 3:
                return {last.x - p.x, last.y - p.y};
            case 4:
                return {p.x, last.y - p.y};
            case 5:
                return {p.y, p.x};
            case 6:
                return {p.y, last.y - p.x};
            case 7:
                return {last.x - p.y, last.y - p.x};
            case 8:
                return {last.x - p.y, p.x};
            default:
                return p;
            }
        }();
        return in_window - stored_at_;
    }

  private:
    glm::ivec2 stored_px_, window_px_, stored_at_{0};
    int orientation_;
};

/// Whether a part of a file has what a picture or a map is made of.
bool has_values(const OIIO::ImageSpec& spec) {
    const auto has = [&](const char* name) {
        return std::ranges::any_of(spec.channelnames, [&](const std::string& channel) {
            return channel == name || channel.ends_with(std::string(".") + name);
        });
    };
    return (has("R") && has("G") && has("B")) || (has("X") && has("Y") && has("Z")) || has("Y");
}

class OiioDecoder final : public PictureDecoder {
  public:
    /// `memory`: that it reads from, if it is not a file. `as_stored`: not turned upright.
    explicit OiioDecoder(std::unique_ptr<OIIO::ImageInput> input,
                         std::unique_ptr<OIIO::Filesystem::IOProxy> memory = nullptr, bool as_stored = false)
        : memory_(std::move(memory)), input_(std::move(input)),
          is_exr_(input_->format_name() == std::string_view("openexr")), header_(header_of(input_->spec())),
          layout_(input_->spec(), is_exr_, as_stored) {
        // Each file is read by one thread: several are read at once.
        input_->threads(1);
        header_.format = input_->format_name();
        if (!layout_.is_plain()) {
            header_.size_px = layout_.picture_px();
            header_.stored_px = layout_.stored_px();
        }
    }
    const PictureHeader& header() const override { return header_; }
    std::string read(int begin_row, int end_row, int channels, PixelType as, void* into) override {
        if (layout_.is_plain())
            return read_stored(begin_row, end_row, channels, as, into);
        const std::size_t bytes =
            static_cast<std::size_t>(channels) *
            (as == PixelType::other ? input_->spec().format.size() : type_desc(as).size());
        if (std::string fault = keep_stored(channels, as, bytes); !fault.empty())
            return fault;
        auto* out = static_cast<char*>(into);
        for (int y = begin_row; y < end_row; ++y) {
            for (int x = 0; x < header_.size_px.x; ++x, out += bytes) {
                const glm::ivec2 p = layout_.stored_pixel({x, y}), size = layout_.stored_px();
                if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y)
                    std::fill_n(out, bytes, '\0');
                else
                    std::copy_n(&kept_[(static_cast<std::size_t>(p.y) * static_cast<std::size_t>(size.x) +
                                        static_cast<std::size_t>(p.x)) *
                                       bytes],
                                bytes, out);
            }
        }
        return {};
    }

  private:
    /// All stored pixels, once for all rows that are asked for.
    std::string keep_stored(int channels, PixelType as, std::size_t pixel_bytes) {
        if (kept_channels_ == channels && kept_as_ == as)
            return {};
        const glm::ivec2 size = layout_.stored_px();
        kept_channels_ = 0;
        kept_.resize(pixel_bytes * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
        std::string fault = read_stored(0, size.y, channels, as, kept_.data());
        if (fault.empty()) {
            kept_channels_ = channels;
            kept_as_ = as;
        }
        return fault;
    }

    std::string read_stored(int begin_row, int end_row, int channels, PixelType as, void* into) {
        const bool all = begin_row == 0 && end_row == input_->spec().height;
        const int top = input_->spec().y, part = input_->current_subimage();
        const bool was_read =
            all ? input_->read_image(part, 0, 0, channels, type_desc(as), into)
                : input_->read_scanlines(part, 0, top + begin_row, top + end_row, input_->spec().z, 0,
                                         channels, type_desc(as), into);
        if (!was_read)
            return input_->geterror();
        for (int channel = 0; is_exr_ && as == PixelType::float32 && channel < channels; ++channel) {
            if (input_->spec().channelformat(channel) != TypeDesc(TypeDesc::UINT32))
                continue;
            if (std::string fault =
                    read_whole_numbers(begin_row, end_row, channel, channels, static_cast<float*>(into));
                !fault.empty())
                return fault;
        }
        return {};
    }

    /// OpenEXR's whole numbers are what they say; OpenImageIO would take the largest for 1.
    std::string read_whole_numbers(int begin_row, int end_row, int channel, int channels, float* into) {
        const OIIO::ImageSpec& spec = input_->spec();
        std::vector<std::uint32_t> numbers(static_cast<std::size_t>(spec.width) *
                                           static_cast<std::size_t>(end_row - begin_row));
        const bool all = begin_row == 0 && end_row == spec.height;
        const int part = input_->current_subimage();
        const bool was_read =
            all ? input_->read_image(part, 0, channel, channel + 1, TypeDesc::UINT32, numbers.data())
                : input_->read_scanlines(part, 0, spec.y + begin_row, spec.y + end_row, spec.z, channel,
                                         channel + 1, TypeDesc::UINT32, numbers.data());
        if (!was_read)
            return input_->geterror();
        into += channel;
        for (const std::uint32_t number : numbers) {
            *into = static_cast<float>(number);
            into += channels;
        }
        return {};
    }

    std::unique_ptr<OIIO::Filesystem::IOProxy> memory_; // outlives its reader
    std::unique_ptr<OIIO::ImageInput> input_;
    bool is_exr_;
    PictureHeader header_;
    Layout layout_;
    std::vector<char> kept_; ///< of kept_channels_ channels as kept_as_; 0: nothing yet
    int kept_channels_ = 0;
    PixelType kept_as_ = PixelType::other;
};

class OiioLibrary final : public PictureLibrary {
  public:
    std::unique_ptr<PictureDecoder> open(const std::string& file, bool straight,
                                         std::string& fault) const override {
        OIIO::ImageSpec wish;
        if (straight)
            wish.attribute("oiio:UnassociatedAlpha", 1);
        if (auto input = OIIO::ImageInput::open(file, &wish)) {
            // Of an OpenEXR file in parts the first that has light or coordinates.
            if (input->format_name() == std::string_view("openexr") && !has_values(input->spec())) {
                int part = 1;
                while (input->seek_subimage(part, 0) && !has_values(input->spec()))
                    ++part;
                if (!has_values(input->spec()))
                    input->seek_subimage(0, 0);
            }
            return std::make_unique<OiioDecoder>(std::move(input));
        }
        fault = OIIO::geterror();
        return nullptr;
    }
    std::unique_ptr<PictureDecoder> open_bytes(std::string_view bytes, const std::string& format,
                                               bool straight, std::string& fault) const override {
        auto memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<char*>(bytes.data()),
                                                                      bytes.size()); // it only reads
        auto input = OIIO::ImageInput::create(format);
        OIIO::ImageSpec wish, spec;
        if (straight)
            wish.attribute("oiio:UnassociatedAlpha", 1);
        if (input && input->set_ioproxy(memory.get()) && input->open("in memory." + format, spec, wish))
            return std::make_unique<OiioDecoder>(std::move(input), std::move(memory), true);
        fault = input ? input->geterror() : OIIO::geterror();
        input.reset();
        return nullptr;
    }
    std::string encode(const std::string& name, const PictureHeader& header, PixelType type,
                       const void* pixels, std::vector<unsigned char>& bytes) const override {
        OIIO::ImageSpec spec(header.size_px.x, header.size_px.y, header.channel_count(),
                             type_desc(header.type));
        spec.channelnames = header.channels;
        spec.alpha_channel = header.alpha_channel;
        for (const auto& [key, value] : header.attributes)
            write_attribute(spec, key, value);
        // OpenImageIO would write the time of day into an EXR file: the same picture shall have the same
        // bytes.
        if (name.ends_with(".exr") && !header.attribute<std::string>("DateTime"))
            spec.attribute("DateTime", "1970:01:01 00:00:00");
        // Into memory: when a disk fills up, libraries of picture formats do not always say so.
        OIIO::Filesystem::IOVecOutput memory;
        const auto output = OIIO::ImageOutput::create(name);
        if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
            !output->write_image(type_desc(type), pixels) || !output->close())
            return output ? output->geterror() : OIIO::geterror();
        bytes = memory.buffer();
        return {};
    }
};

} // namespace

} // namespace overt

extern "C" __attribute__((visibility("default"))) const overt::PictureLibrary* overt_picture_library() {
    static const overt::OiioLibrary library;
    return &library;
}
