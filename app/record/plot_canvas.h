/// A diagram of lines, boxes, dots and words, drawn once and written as SVG or as PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace overt {

/// Places and lengths are in the points of the SVG's view box, origin at the top left; colours are "#rrggbb".
class PlotCanvas {
  public:
    enum class Anchor : std::uint8_t { start, middle, end };

    /// `turned`: the words run upwards, and (x, y) is where their middle stands.
    void text(double x, double y, const std::string& words, Anchor anchor = Anchor::middle,
              double size = 12.0, bool turned = false);
    void line(double x1, double y1, double x2, double y2, const char* colour, double thickness = 1.0);
    void box(double x, double y, double width, double height, const char* colour);
    void outline(double x, double y, double width, double height, const char* colour);
    void dot(double x, double y, double radius, const char* colour);

    std::string svg(double width, double height) const;
    /// With `scale` pixels to a point, on white. Throws RecordError if the picture cannot be made.
    std::vector<std::byte> png(double width, double height, double scale) const;

    /// Throws InputError unless the file's name ends in .svg or .png.
    static void check_ending(const std::filesystem::path& file);
    /// As SVG or PNG, as the name's ending says; in place of a file that is there. Throws as above, and
    /// RecordError.
    void write(const std::filesystem::path& file, double width, double height) const;

  private:
    struct Mark {
        enum class Kind : std::uint8_t { text, line, box, outline, dot } kind;
        double x = 0.0, y = 0.0; ///< of a dot the centre, of words the anchor, of a line one end
        double a = 0.0, b = 0.0; ///< width and height, or a line's other end; of a dot the radius and nothing
        double size = 1.0;       ///< of words, or a line's thickness
        std::string colour = {}, words = {};
        Anchor anchor = Anchor::start;
        bool turned = false;
    };
    std::vector<Mark> marks_;
};

} // namespace overt
