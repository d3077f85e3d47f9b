// The words of a scene file for the choices in scene.h: one list, used to read and to print.
#pragma once

#include <datasets/scene/scene.h>

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace swimtwin
{
  /// Specialised for every choice of scene.h: `list` holds pairs (word, value).
  template <typename Enum>
  struct Names;

  template <>
  struct Names<HeadShape>
  {
    static constexpr std::array<std::pair<std::string_view, HeadShape>, 3> list{
        {{"rectangle", HeadShape::rectangle}, {"disc", HeadShape::disc}, {"ellipse", HeadShape::ellipse}}};
  };

  /// The same shapes turned about x: what a head is called in three dimensions.
  inline constexpr std::array<std::pair<std::string_view, HeadShape>, 4> head_shapes_in_space{
      {{"cylinder", HeadShape::rectangle},
       {"sphere", HeadShape::disc},
       {"ellipsoid", HeadShape::ellipse},
       {"surface", HeadShape::surface}}};

  /// What the scenes of a dimension call the shapes of a head.
  inline std::span<const std::pair<std::string_view, HeadShape>> head_shapes(const int dimension)
  {
    if (dimension == 3)
      return head_shapes_in_space;
    return Names<HeadShape>::list;
  }
  inline std::string_view name_of(const HeadShape shape, const int dimension)
  {
    for (const auto &[word, value] : head_shapes(dimension))
      if (value == shape)
        return word;
    return {};
  }

  /// The shapes that a domain may have in the plane, and in space.
  inline constexpr std::array<std::pair<std::string_view, DomainShape>, 4> domain_shapes_in_plane{
      {{"box", DomainShape::box},
       {"channel", DomainShape::channel},
       {"disc", DomainShape::disc},
       {"annulus", DomainShape::annulus}}};
  inline constexpr std::array<std::pair<std::string_view, DomainShape>, 5> domain_shapes_in_space{
      {{"box", DomainShape::box},
       {"channel", DomainShape::channel},
       {"cylinder", DomainShape::cylinder},
       {"sphere", DomainShape::sphere},
       {"surface", DomainShape::surface}}};

  template <>
  struct Names<TipShape>
  {
    static constexpr std::array<std::pair<std::string_view, TipShape>, 2> list{
        {{"rounded", TipShape::rounded}, {"flat", TipShape::flat}}};
  };

  template <>
  struct Names<TailSection>
  {
    static constexpr std::array<std::pair<std::string_view, TailSection>, 2> list{
        {{"circular", TailSection::circular}, {"rectangular", TailSection::rectangular}}};
  };

  template <>
  struct Names<MaterialModel>
  {
    static constexpr std::array<std::pair<std::string_view, MaterialModel>, 4> list{
        {{"st-venant-kirchhoff", MaterialModel::st_venant_kirchhoff},
         {"neo-hookean", MaterialModel::neo_hookean},
         {"rigid", MaterialModel::rigid},
         {"prescribed", MaterialModel::prescribed}}};
  };

  template <>
  struct Names<DomainShape>
  {
    static constexpr std::array<std::pair<std::string_view, DomainShape>, 7> list{{{"box", DomainShape::box},
                                                                                   {"channel", DomainShape::channel},
                                                                                   {"disc", DomainShape::disc},
                                                                                   {"annulus", DomainShape::annulus},
                                                                                   {"cylinder", DomainShape::cylinder},
                                                                                   {"sphere", DomainShape::sphere},
                                                                                   {"surface", DomainShape::surface}}};
  };

  template <>
  struct Names<WallCondition>
  {
    static constexpr std::array<std::pair<std::string_view, WallCondition>, 5> list{
        {{"no-slip", WallCondition::no_slip},
         {"traction-free", WallCondition::traction_free},
         {"moving-wall", WallCondition::moving_wall},
         {"inflow", WallCondition::inflow},
         {"shear-flow", WallCondition::shear_flow}}};
  };

  template <>
  struct Names<InflowProfile>
  {
    static constexpr std::array<std::pair<std::string_view, InflowProfile>, 2> list{
        {{"parabolic", InflowProfile::parabolic}, {"uniform", InflowProfile::uniform}}};
  };

  template <>
  struct Names<Inertia>
  {
    static constexpr std::array<std::pair<std::string_view, Inertia>, 3> list{
        {{"auto", Inertia::automatic}, {"none", Inertia::none}, {"full", Inertia::full}}};
  };

  /// Terms of inertia as [fluid] inertia lists them.
  inline constexpr std::array<std::pair<std::string_view, bool InertiaTerms::*>, 4> inertia_term_names{
      {{"unsteady", &InertiaTerms::unsteady},
       {"convective", &InertiaTerms::convective},
       {"tail", &InertiaTerms::tail},
       {"head", &InertiaTerms::head}}};

  template <>
  struct Names<LinearSolver>
  {
    static constexpr std::array<std::pair<std::string_view, LinearSolver>, 3> list{
        {{"auto", LinearSolver::automatic}, {"direct", LinearSolver::direct}, {"iterative", LinearSolver::iterative}}};
  };

  template <>
  struct Names<CouplingScheme>
  {
    static constexpr std::array<std::pair<std::string_view, CouplingScheme>, 2> list{
        {{"monolithic", CouplingScheme::monolithic}, {"fixed-point", CouplingScheme::fixed_point}}};
  };

  template <>
  struct Names<AccelerationMethod>
  {
    static constexpr std::array<std::pair<std::string_view, AccelerationMethod>, 2> list{
        {{"aitken", AccelerationMethod::aitken}, {"iqn-ils", AccelerationMethod::iqn_ils}}};
  };

  template <>
  struct Names<SymmetricHalf>
  {
    static constexpr std::array<std::pair<std::string_view, SymmetricHalf>, 3> list{
        {{"auto", SymmetricHalf::automatic}, {"on", SymmetricHalf::on}, {"off", SymmetricHalf::off}}};
  };

  template <>
  struct Names<MeshMotion>
  {
    static constexpr std::array<std::pair<std::string_view, MeshMotion>, 3> list{
        {{"elastic", MeshMotion::elastic},
         {"weighted-harmonic", MeshMotion::weighted_harmonic},
         {"harmonic", MeshMotion::harmonic}}};
  };

  template <>
  struct Names<HeadMotion>
  {
    static constexpr std::array<std::pair<std::string_view, HeadMotion>, 3> list{
        {{"free", HeadMotion::free}, {"fixed", HeadMotion::fixed}, {"prescribed", HeadMotion::prescribed}}};
  };

  template <>
  struct Names<FieldProgram::Waveform>
  {
    static constexpr std::array<std::pair<std::string_view, FieldProgram::Waveform>, 4> list{
        {{"none", FieldProgram::Waveform::none},
         {"constant", FieldProgram::Waveform::constant},
         {"sinusoidal", FieldProgram::Waveform::sinusoidal},
         {"sampled", FieldProgram::Waveform::sampled}}};
  };

  /// The word of a scene file for a choice, `no-slip` for WallCondition::no_slip.
  template <typename Enum, typename = decltype(Names<Enum>::list)>
  constexpr std::string_view to_string(const Enum value)
  {
    for (const auto &[word, candidate] : Names<Enum>::list)
      if (candidate == value)
        return word;
    return "unknown";
  }
} // namespace swimtwin
