#include "scenes/engine.h"

#include "scenes/shapes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace abut::scenes {

namespace {

// Metres. The crank's axis is the x axis.
constexpr double kThrow = 0.043;         ///< radius of the crank
constexpr double kRod = 0.140;           ///< length of a rod, from pin to pin
constexpr double kSpacing = 0.100;       ///< of the cylinders
constexpr double kBore = 0.042;          ///< radius
constexpr double kCounterweight = 0.068; ///< radius
constexpr double kSkirt = 0.025;         ///< from a piston's pin down
constexpr double kLongSkirt = 0.033;     ///< reaches 4 mm into the counterweights
constexpr double kApart = 0.0001;        ///< between solids of one part, which must not overlap
constexpr int kSides = 48;

Transform shift(double x, double y, double z) {
    return Transform({1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z});
}

/// Maps the x axis to the z axis.
Transform upright(double x, double z) {
    return Transform({0, 0, 1, 0, 1, 0, -1, 0, 0, x, 0, z});
}

/// A cylinder along x, from x - length/2, at a height.
void add_round(Shape& shape, double x, double length, double radius, double z) {
    append(shape, lathe({{0, radius}, {length, radius}}, kSides), shift(x - 0.5 * length, 0, z));
}

/// The height of a crank pin at rest: pins are up and down, as in an engine of four cylinders.
double pin_height(int cylinder) {
    const int place = cylinder % 4;
    return place == 0 || place == 3 ? kThrow : -kThrow;
}

/// A web of the crank with its counterweight, as a section in (y, z).
std::vector<Point2> web_section(double side) {
    std::vector<Point2> section;
    constexpr int kSteps = 24;
    for (int i = 0; i <= kSteps; ++i) { // the arc of the counterweight, opposite to the pin
        const double angle = std::numbers::pi * (200.0 + 140.0 * i / kSteps) / 180;
        section.push_back({kCounterweight * std::cos(angle), kCounterweight * std::sin(angle)});
    }
    section.push_back({0.028, 0.050});
    section.push_back({0.012, 0.066});
    section.push_back({-0.012, 0.066});
    section.push_back({-0.028, 0.050});
    if (side < 0)
        for (Point2& p : section) // half a turn about the crank's axis
            p = {-p.u, -p.v};
    return section;
}

Shape crank(int cylinders) {
    Shape shape;
    const double web = 0.010;
    for (int i = 0; i < cylinders; ++i) {
        const double x = i * kSpacing;
        const double pin = pin_height(i);
        add_round(shape, x, 0.028 - 2 * kApart, 0.022, pin);
        for (const double side : {-1.0, 1.0}) {
            const double middle = x + side * (0.014 + 0.5 * web);
            append(shape, prism(web, web_section(pin)), shift(middle - 0.5 * web, 0, 0));
        }
        // The main bearing to the next cylinder; a stub at the end.
        const double length = kSpacing - 0.048 - 2 * kApart;
        add_round(shape, x + 0.5 * kSpacing, length, 0.025, 0);
    }
    return shape;
}

Shape rod(double x, double crank_pin) {
    Shape shape;
    const double pin = crank_pin + kRod;
    add_round(shape, x, 0.020, 0.030, crank_pin);
    add_round(shape, x, 0.020, 0.015, pin);
    const double low = crank_pin + 0.030 + kApart;
    const double high = pin - 0.015 - kApart;
    append(shape, box({{x - 0.007, -0.010, low}, {x + 0.007, 0.010, high}}), {});
    return shape;
}

Shape piston(double x, double pin, double skirt) {
    Shape shape;
    const double radius = kBore - 0.0001;
    append(shape, lathe({{0, radius}, {skirt + 0.035, radius}}, kSides), upright(x, pin - skirt));
    return shape;
}

Shape liners(int cylinders) {
    Shape shape;
    const double length = 0.160;
    for (int i = 0; i < cylinders; ++i)
        append(shape,
               lathe({{0, kBore}, {0, kBore + 0.004}, {length, kBore + 0.004}, {length, kBore}},
                     kSides, true),
               upright(i * kSpacing, 0.070));
    return shape;
}

/// A text as TOML has it between quotation marks.
std::string toml_text(const std::string& raw) {
    std::string text;
    for (const char c : raw)
        if (c == '"' || c == '\\')
            text += std::string("\\") + c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            text += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            text += c;
    return text;
}

class EngineMaker {
public:
    EngineMaker(const EngineOptions& options, const std::string& model_file)
        : cylinders_(std::clamp(options.cylinders, 1, 1000)), clashes_(options.clashes),
          model_(toml_text(model_file)) {
        engine_.scene.up = UpAxis::z;
        engine_.assembly = "# An engine: the crank turns twice. Lengths in mm, angles in degrees, "
                           "times in s.\nunit = \"mm\"\nup = \"z\"\n";
    }

    Engine make() {
        add("block", liners(cylinders_), "");
        add("crank", crank(cylinders_),
            "on = \"block\"\njoint = { type = \"revolute\", axis = [1, 0, 0] }\n"
            "times = [0, 0.04]\nvalues = [90, 810]\n");
        const int long_piston = std::min(2, cylinders_ - 1);
        for (int i = 0; i < cylinders_; ++i)
            add_cylinder(i, clashes_ && i == long_piston ? kLongSkirt : kSkirt);
        const double middle = 0.5 * (cylinders_ - 1) * kSpacing;
        const double half = middle + 0.06;
        Shape tray;
        append(tray, box({{middle - half, -0.08, -0.080}, {middle + half, 0.08, -0.078}}), {});
        add("tray", tray, "on = \"block\"\n");
        if (clashes_) {
            Shape screw;
            append(screw, lathe({{0, 0.004}, {0.008, 0.004}}, 12), upright(0, -0.078 + kApart));
            add("screw", screw, "on = \"tray\"\n");
        }
        for (int i = 1; i <= cylinders_; ++i)
            engine_.assembly +=
                fmt::format("\n[[loops]]\ncoupler = \"rod {}\"\ncloser = \"piston {}\"\n"
                            "pin = [{:g}, 0, {:g}]\n",
                            i, i, 1e3 * (i - 1) * kSpacing, 1e3 * (pin_height(i - 1) + kRod));
        return std::move(engine_);
    }

private:
    void add_cylinder(int i, double skirt) {
        const double x = i * kSpacing;
        const double pin = pin_height(i);
        add(fmt::format("rod {}", i + 1), rod(x, pin),
            fmt::format("on = \"crank\"\njoint = {{ type = \"revolute\", axis = [1, 0, 0], "
                        "origin = [{:g}, 0, {:g}] }}\n",
                        1e3 * x, 1e3 * pin));
        add(fmt::format("piston {}", i + 1), piston(x, pin + kRod, skirt),
            "on = \"block\"\njoint = { type = \"prismatic\", axis = [0, 0, 1] }\n");
    }

    void add(const std::string& name, const Shape& shape, const std::string& lines) {
        Part part;
        part.id = part.name = name;
        part.mesh = static_cast<std::uint32_t>(engine_.scene.meshes.size());
        engine_.scene.meshes.push_back(shape.mesh);
        engine_.scene.parts.push_back(part);
        engine_.assembly += fmt::format(
            "\n[[parts]]\nname = \"{0}\"\nmodel = \"{1}\"\nselect = 'name = \"{0}\"'\n{2}", name,
            model_, lines);
    }

    int cylinders_;
    bool clashes_;
    std::string model_;
    Engine engine_;
};

} // namespace

Engine make_engine(const EngineOptions& options, const std::string& model_file) {
    return EngineMaker(options, model_file).make();
}

} // namespace abut::scenes
