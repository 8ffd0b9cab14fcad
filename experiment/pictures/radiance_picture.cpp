#include "experiment/pictures/radiance_picture.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "experiment/base/whole_file.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

namespace {

/// Of white light, by which XYZE pictures of Radiance hold luminance and RGBE pictures radiance.
constexpr double lumens_per_watt = 179.0;

/// How the pixels lie in the file: scanlines one after another along the slow axis.
struct ScanOrder {
    bool rows_are_scanlines = true; ///< else columns are
    bool from_top = true, from_left = true;
    int scanlines = 0, scanline_px = 0;

    glm::ivec2 size_px() const {
        return rows_are_scanlines ? glm::ivec2(scanline_px, scanlines) : glm::ivec2(scanlines, scanline_px);
    }
    /// Column and row, from the top left, of a pixel of a scanline.
    glm::ivec2 place_of(int scanline, int pixel) const {
        const glm::ivec2 size = size_px();
        const int row = rows_are_scanlines ? scanline : pixel, column = rows_are_scanlines ? pixel : scanline;
        return {from_left ? column : size.x - 1 - column, from_top ? row : size.y - 1 - row};
    }
};

struct RadianceHeader {
    ScanOrder order;
    glm::dvec3 factor{1.0}; ///< from stored values to light
    PictureHeader picture;
    std::size_t pixels_begin = 0;
    bool is_xyz = false;
};

/// The numbers of a header line behind its "="; nothing unless there are as many.
std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t begin = text.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos)
            break;
        text.remove_prefix(begin);
        if (text.front() == '+')
            text.remove_prefix(1);
        double number = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || !std::isfinite(number))
            return std::nullopt;
        numbers.push_back(number);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

/// Takes a line of the header. Gives what is wrong with it.
std::string take_line(std::string_view line, RadianceHeader& into) {
    // Lines of the pictures that this one was made from are indented.
    const auto value_of = [&](std::string_view name) {
        return line.starts_with(name) && line.substr(name.size()).starts_with('=')
                   ? std::optional(line.substr(name.size() + 1))
                   : std::nullopt;
    };
    const auto is_positive = [](const std::optional<std::vector<double>>& numbers) {
        return numbers && std::ranges::all_of(*numbers, [](double number) { return number > 0.0; });
    };
    if (const auto format = value_of("FORMAT")) {
        const std::size_t begin = format->find_first_not_of(' ');
        const std::string_view name = begin == std::string_view::npos ? "" : format->substr(begin);
        if (name == "32-bit_rle_xyze") {
            into.is_xyz = true;
            into.factor /= lumens_per_watt;
            into.picture.primaries = {1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0 / 3.0, 1.0 / 3.0};
        } else if (name != "32-bit_rle_rgbe") {
            return fmt::format("its {} is none that is read: 32-bit_rle_rgbe and 32-bit_rle_xyze are", line);
        }
    } else if (const auto exposure = value_of("EXPOSURE")) {
        const auto numbers = numbers_in(*exposure, 1);
        if (!is_positive(numbers))
            return fmt::format("its line \"{}\" has no number above 0", line);
        into.factor /= numbers->front();
    } else if (const auto correction = value_of("COLORCORR")) {
        const auto numbers = numbers_in(*correction, 3);
        if (!is_positive(numbers))
            return fmt::format("its line \"{}\" has no three numbers above 0", line);
        into.factor /= glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    } else if (const auto primaries = value_of("PRIMARIES")) {
        const auto numbers = numbers_in(*primaries, 8);
        if (!numbers)
            return fmt::format("its line \"{}\" has no eight numbers", line);
        // XYZ has its own.
        if (!into.is_xyz)
            std::ranges::copy(*numbers, into.picture.primaries.emplace().begin());
    } else if (const auto gamma = value_of("GAMMA")) {
        const auto numbers = numbers_in(*gamma, 1);
        if (!numbers || numbers->front() != 1.0)
            return fmt::format(
                "its line \"{}\" says that its values are no linear light; save it with linear "
                "light",
                line);
    }
    return {};
}

/// "-Y 512 +X 1024" and the seven others.
std::optional<ScanOrder> scan_order_of(std::string_view line) {
    char slow_sign = 0, slow = 0, fast_sign = 0, fast = 0;
    ScanOrder order;
    const std::string text(line);
    int end = 0;
    if (std::sscanf(text.c_str(), "%c%c %9d %c%c %9d%n", &slow_sign, &slow, &order.scanlines, &fast_sign,
                    &fast, &order.scanline_px, &end) != 6)
        return std::nullopt;
    const auto is_sign = [](char c) { return c == '+' || c == '-'; };
    if (text.find_first_not_of(" \t\r", static_cast<std::size_t>(end)) != std::string::npos ||
        !is_sign(slow_sign) || !is_sign(fast_sign) || order.scanlines < 1 || order.scanline_px < 1)
        return std::nullopt;
    if (!(slow == 'Y' && fast == 'X') && !(slow == 'X' && fast == 'Y'))
        return std::nullopt;
    order.rows_are_scanlines = slow == 'Y';
    // X grows to the right and Y upwards; the sign says which way scanlines, and pixels in them, follow.
    order.from_top = (order.rows_are_scanlines ? slow_sign : fast_sign) == '-';
    order.from_left = (order.rows_are_scanlines ? fast_sign : slow_sign) == '+';
    return order;
}

/// Gives what is wrong.
std::string read_header(std::string_view bytes, RadianceHeader& into) {
    into.picture.channels = {"R", "G", "B"};
    into.picture.type = PixelType::float32;
    into.picture.type_name = "rgbe";
    into.picture.format = "radiance";
    std::size_t at = 0;
    const auto next_line = [&]() -> std::optional<std::string_view> {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos)
            return std::nullopt;
        std::string_view line = bytes.substr(at, end - at);
        at = end + 1;
        if (line.ends_with('\r'))
            line.remove_suffix(1);
        return line;
    };
    while (true) {
        const auto line = next_line();
        if (!line)
            return "it ends inside its header";
        if (line->empty())
            break;
        if (const std::string fault = take_line(*line, into); !fault.empty())
            return fault;
    }
    const auto line = next_line();
    const auto order = line ? scan_order_of(*line) : std::nullopt;
    if (!order)
        return "the line behind its header is no resolution such as \"-Y 512 +X 1024\"";
    into.order = *order;
    into.picture.size_px = order->size_px();
    into.pixels_begin = at;
    return {};
}

using Rgbe = std::array<unsigned char, 4>;

/// Reads scanlines one after another. Nothing more is read once a fault was found.
class ScanlineReader {
  public:
    explicit ScanlineReader(std::string_view bytes) : bytes_(bytes) {}

    /// False at a fault.
    bool read(std::vector<Rgbe>& into) {
        // The new run lengths are known by a first pixel that no colour has.
        constexpr std::size_t least_px = 8, most_px = 0x7fff;
        if (into.size() >= least_px && into.size() <= most_px && left() >= 4 && byte(0) == 2 &&
            byte(1) == 2 && byte(2) < 128) {
            if ((byte(2) << 8 | byte(3)) != static_cast<int>(into.size()))
                return false;
            at_ += 4;
            return read_components(into);
        }
        return read_pixels(into);
    }

  private:
    std::size_t left() const { return bytes_.size() - at_; }
    int byte(std::size_t ahead) const { return static_cast<unsigned char>(bytes_[at_ + ahead]); }

    /// Each component for itself, in runs and in stretches of different values.
    bool read_components(std::vector<Rgbe>& into) {
        for (std::size_t component = 0; component < 4; ++component) {
            for (std::size_t i = 0; i < into.size();) {
                if (left() < 2)
                    return false;
                const int code = byte(0);
                const bool is_run = code > 128;
                const auto count = static_cast<std::size_t>(is_run ? code - 128 : code);
                if (count == 0 || count > into.size() - i || left() < 1 + (is_run ? 1 : count))
                    return false;
                for (std::size_t k = 0; k < count; ++k)
                    into[i++][component] = static_cast<unsigned char>(byte(is_run ? 1 : 1 + k));
                at_ += 1 + (is_run ? 1 : count);
            }
        }
        return true;
    }

    /// Whole pixels; in old files 1, 1, 1, n repeats the last n times, and one that follows it counts 256 n,
    /// and so on.
    bool read_pixels(std::vector<Rgbe>& into) {
        int shift = 0;
        for (std::size_t i = 0; i < into.size();) {
            if (left() < 4)
                return false;
            Rgbe pixel;
            std::memcpy(pixel.data(), bytes_.data() + at_, 4);
            at_ += 4;
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                into[i++] = pixel;
                shift = 0;
                continue;
            }
            const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : 0;
            if (i == 0 || shift >= 32 || count > into.size() - i)
                return false;
            std::fill_n(into.begin() + static_cast<std::ptrdiff_t>(i), count, into[i - 1]);
            i += count;
            shift += 8;
        }
        return true;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

class RadianceDecoder final : public PictureDecoder {
  public:
    RadianceDecoder(std::string bytes, RadianceHeader header)
        : bytes_(std::move(bytes)), header_(std::move(header)) {}
    const PictureHeader& header() const override { return header_.picture; }
    std::string read(int begin_row, int end_row, int channels, PixelType as, void* into) override {
        if (as != PixelType::float32 && as != PixelType::other)
            return "it holds no whole numbers";
        if (light_.empty()) {
            if (std::string fault = decode(); !fault.empty())
                return fault;
        }
        auto* out = static_cast<float*>(into);
        const int width = header_.picture.size_px.x;
        for (int row = begin_row; row < end_row; ++row) {
            for (int column = 0; column < width; ++column) {
                const float* const pixel =
                    &light_[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(column))];
                out = std::copy_n(pixel, channels, out);
            }
        }
        return {};
    }

  private:
    std::string decode() {
        const ScanOrder& order = header_.order;
        const glm::ivec2 size = order.size_px();
        std::vector<float> light(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
        std::vector<Rgbe> scanline(static_cast<std::size_t>(order.scanline_px));
        ScanlineReader reader(std::string_view(bytes_).substr(header_.pixels_begin));
        for (int line = 0; line < order.scanlines; ++line) {
            if (!reader.read(scanline))
                return fmt::format("its scanline {} of {} is cut off or damaged", line + 1, order.scanlines);
            for (int i = 0; i < order.scanline_px; ++i) {
                const Rgbe& stored = scanline[static_cast<std::size_t>(i)];
                const glm::ivec2 place = order.place_of(line, i);
                float* const pixel =
                    &light[3 * (static_cast<std::size_t>(place.y) * static_cast<std::size_t>(size.x) +
                                static_cast<std::size_t>(place.x))];
                // An exponent of 0 means black; 128 + 8 takes the mantissas below 1.
                const double unit = stored[3] == 0 ? 0.0 : std::ldexp(1.0, stored[3] - 136);
                for (int channel = 0; channel < 3; ++channel)
                    pixel[channel] = static_cast<float>(stored[static_cast<std::size_t>(channel)] * unit *
                                                        header_.factor[channel]);
            }
        }
        light_ = std::move(light);
        bytes_.clear();
        bytes_.shrink_to_fit();
        return {};
    }

    std::string bytes_;
    RadianceHeader header_;
    std::vector<float> light_; ///< once it was decoded
};

} // namespace

std::unique_ptr<PictureDecoder> open_radiance(const std::string& file, std::string& fault) {
    {
        std::ifstream beginning(file, std::ios::binary);
        std::array<char, 2> mark{};
        if (!beginning.read(mark.data(), 2) || mark != std::array{'#', '?'})
            return nullptr;
    }
    int error = 0;
    std::optional<std::string> bytes = read_whole_file(file, most_picture_bytes, error);
    if (!bytes) {
        fault = std::strerror(error);
        return nullptr;
    }
    RadianceHeader header;
    fault = read_header(*bytes, header);
    if (!fault.empty())
        return nullptr;
    return std::make_unique<RadianceDecoder>(*std::move(bytes), std::move(header));
}

} // namespace overt
