// Head and tail.
#include <datasets/scene/scene_parts.h>
#include <datasets/scene/scene_surfaces.h>
#include <datasets/system/error.h>

#include <cmath>

namespace swimtwin
{
  namespace
  {
    constexpr Range poisson_range{-1., 0.5, true, true, "lie between -1 and 0.5, both excluded"};

    constexpr Range blunt{0., infinity, true, false, "be positive, for elements end in no point: blunt the tip"};

    HeadOscillation read_oscillation(const TomlDocument &document)
    {
      TomlTable       table(document, "head.oscillation");
      HeadOscillation oscillation;
      table.pair("amplitude_m", optional("m", any_number), oscillation.amplitude_m);
      table.number("angle_rad", optional("rad", any_number), oscillation.angle_rad);
      table.number("frequency_Hz", required("Hz"), oscillation.frequency_Hz);
      table.number("phase_rad", optional("rad", any_number), oscillation.phase_rad);
      table.finish();
      return oscillation;
    }

    TailWave read_wave(const TomlDocument &document)
    {
      TomlTable table(document, "tail.wave");
      TailWave  wave;
      table.number("angle_rad", required("rad", any_number), wave.angle_rad);
      table.number("frequency_Hz", required("Hz"), wave.frequency_Hz);
      table.number("waves", optional("", any_number), wave.waves);
      table.number("phase_rad", optional("rad", any_number), wave.phase_rad);
      table.finish();
      return wave;
    }

    /// Straight sides, or points that they go through; from these follow the three lengths of straight ones.
    void read_tail_shape(TomlTable &table, const bool is_in_surface, Tail &tail)
    {
      read_choice(table, "section", tail.section);
      table.number("width_m", optional("m"), tail.width_m);
      if (tail.section == TailSection::rectangular)
        tail.tip = TipShape::flat;
      read_choice(table, "tip", tail.tip);
      table.pairs("profile_m", optional("m", any_number), tail.profile_m); // its rules name the point
      const Need lengths = is_in_surface || table.has("profile_m") ? Need::optional : Need::required;
      table.number("length_m", {"m", positive, lengths}, tail.length_m);
      table.number("root_height_m", {"m", positive, lengths}, tail.root_height_m);
      table.number("tip_height_m", {"m", blunt, lengths}, tail.tip_height_m);
      if (tail.profile_m.empty())
        return;
      const auto &[end, end_half_height] = tail.profile_m.back();
      tail.root_height_m                 = 2. * tail.profile_m.front()[1];
      tail.tip_height_m                  = 2. * end_half_height;
      tail.length_m                      = end + (tail.tip == TipShape::rounded ? end_half_height : 0.);
    }
  } // namespace

  Head read_head(const TomlDocument &document, const int dimension)
  {
    if (document.find("head") == nullptr)
      throw InputError(document.where("") + ": the table [head] is missing; every swimmer has a rigid head.");
    TomlTable table(document, "head");
    Head      head;
    double    diameter_m = 0.;
    table.choice("shape", Need::required, head_shapes(dimension), head.shape);
    table.pair("size_m", optional("m"), head.size_m);
    table.number("diameter_m", optional("m"), diameter_m);
    declare_surface(table);
    const auto center = read_center(table, dimension);
    head.center_m     = {center[0], center[1]};
    table.number("angle_rad", optional("rad", any_number), head.angle_rad);
    table.number("density_kg_m3", optional("kg/m^3"), head.density_kg_m3);
    table.number("magnetization_A_m", optional("A/m", any_number), head.magnetization_A_m);
    table.triple("magnetization_direction", optional("", any_number), head.magnetization_direction);
    table.number("young_modulus_Pa", optional("Pa"), head.young_modulus_Pa);
    table.number("poisson_ratio", optional("", poisson_range), head.poisson_ratio);
    read_choice(table, "motion", head.motion);
    table.table("oscillation");
    table.finish();
    if (center[2] != 0.)
      document.refuse("head", "center_m",
                      "is off the plane z = 0, in which heads start; leave out the third number, and move walls that "
                      "are read from a surface the other way, by [domain] center_m = [x, y, z].");
    if (head.shape == HeadShape::disc)
      head.size_m = {diameter_m, diameter_m};
    head.oscillation    = read_oscillation(document);
    auto &[x, y, z]     = head.magnetization_direction;
    const double length = std::hypot(x, y, z);
    if (length == 0.)
      document.refuse("head", "magnetization_direction", "has no direction; give a vector such as [0.0, 1.0, 0.0].");
    head.magnetization_direction = {x / length, y / length, z / length};
    return head;
  }

  std::optional<Tail> read_tail(const TomlDocument &document, const Head &head)
  {
    TomlTable table(document, "tail");
    Tail      tail;
    read_tail_shape(table, head.shape == HeadShape::surface, tail);
    read_choice(table, "law", tail.law);
    const Need moduli = tail.is_elastic() ? Need::required : Need::optional;
    table.number("young_modulus_Pa", {"Pa", positive, moduli}, tail.young_modulus_Pa);
    table.number("poisson_ratio", {"", poisson_range, moduli}, tail.poisson_ratio);
    table.number("density_kg_m3", required("kg/m^3"), tail.density_kg_m3);
    table.number("magnetization_A_m", optional("A/m", any_number), tail.magnetization_A_m);
    Inertia in_vacuum = Inertia::none;
    read_choice(table, "inertia", in_vacuum);
    tail.has_inertia_in_vacuum = in_vacuum == Inertia::full;
    table.table("wave");
    table.finish();
    tail.wave = read_wave(document);
    return table.present() ? std::optional(tail) : std::nullopt;
  }
} // namespace swimtwin
