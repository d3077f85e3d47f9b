#include <fom/meshing/gmsh_session.h>

#include <datasets/system/error.h>

#include <deal.II/base/mpi.h>
#include <gmsh.h>

#include <clocale>
#include <cstdlib>
#include <new>
#include <optional>
#include <tuple>
#include <type_traits>

namespace swimtwin
{
  using namespace dealii;

  namespace
  {
    /// FLTK, which gmsh asks for its taste in tooltips, writes to the home folder of whoever has one.
    class WithoutHome
    {
    public:
      WithoutHome()
      {
        if (const char *home = std::getenv("HOME"))
          home_ = home;
        ::unsetenv("HOME");
      }
      WithoutHome(const WithoutHome &)            = delete;
      WithoutHome &operator=(const WithoutHome &) = delete;
      ~WithoutHome()
      {
        if (home_)
          ::setenv("HOME", home_->c_str(), 1);
      }

    private:
      std::optional<std::string> home_;
    };

    class GmshSession
    {
    public:
      GmshSession()
      {
        const WithoutHome nobody;
        gmsh::initialize(0, nullptr, false); // without the settings that somebody keeps at home
        std::setlocale(LC_ALL, "C");         // gmsh takes the language of the user
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("Mesh.Algorithm", 6); // frontal Delaunay: the best-shaped triangles
        gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
        gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
        gmsh::option::setNumber("Mesh.MeshSizeMin", 0.);
        gmsh::option::setNumber("Mesh.Smoothing", 3);
      }
      GmshSession(const GmshSession &)            = delete;
      GmshSession &operator=(const GmshSession &) = delete;
      ~GmshSession() { gmsh::finalize(); }
    };

    /// Stopped with the process.
    std::optional<GmshSession> &gmsh_session()
    {
      static std::optional<GmshSession> session;
      return session;
    }

    template <typename T>
    void broadcast(std::vector<T> &values, const MPI_Comm communicator)
    {
      static_assert(std::is_trivially_copyable_v<T>);
      unsigned long long size = values.size();
      MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator);
      values.resize(size);
      MPI_Bcast(values.data(), int(size * sizeof(T)), MPI_BYTE, 0, communicator);
    }

    /// An empty soup and a message if it fails.
    template <int dim>
    std::pair<SimplexSoup<dim>, std::string> try_to_mesh(const std::function<SimplexSoup<dim>()> &generate)
    {
      std::string message = "gmsh returned no elements";
      try
      {
        return {generate(), message};
      }
      catch (const std::exception &failure)
      {
        message = failure.what();
      }
      catch (const std::string &failure) // gmsh 4.8 throws plain strings and numbers
      {
        message = failure;
      }
      catch (const int number)
      {
        message = "gmsh error " + std::to_string(number);
      }
      gmsh_session().reset(); // what is thrown out of gmsh leaves it locked: the next mesh would be empty
      return {{}, message};
    }

    [[noreturn]] void refuse_mesh(const int dim, const std::string &message)
    {
      if (message == std::bad_alloc().what())
        throw OutOfMemory("memory ran out while the fluid was meshed; use a coarser mesh ([numerics] mesh_growth and "
                          "mesh sizes), or allow more memory");
      if (dim == 3 && message.find("PLC Error") != std::string::npos) // a piecewise linear complex
        throw CrossedSurfaces("flat triangles of swimmer and walls go through each other, as they do in a gap narrower "
                              "than curved sides bulge within a triangle, h^2 / (8 R) for the size h and the radius R");
      throw ComputationError("the mesh could not be made" + (message.empty() ? "" : " (" + message + ")") +
                             ": check that the outlines do not cross and that [numerics] mesh sizes fit the geometry");
    }
  } // namespace

  void begin_gmsh_model()
  {
    if (!gmsh_session())
      gmsh_session().emplace();
    std::srand(1); // gmsh perturbs points with rand(): the same region must give the same mesh
    gmsh::clear();
    gmsh::model::add("region");
  }

  template <int dim>
  SimplexSoup<dim> mesh_on_first_rank(const std::function<SimplexSoup<dim>()> &generate, const MPI_Comm communicator)
  {
    SimplexSoup<dim>                     soup;
    std::string                          message;
    std::vector<std::array<double, dim>> coordinates;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      std::tie(soup, message) = try_to_mesh<dim>(generate);
      for (const auto &x : soup.vertices)
      {
        auto &row = coordinates.emplace_back();
        for (int c = 0; c < dim; ++c)
          row[c] = x[c];
      }
    }
    broadcast(coordinates, communicator);
    broadcast(soup.cells, communicator);
    std::vector<char> letters(message.begin(), message.end());
    broadcast(letters, communicator); // all ranks throw alike
    message.assign(letters.begin(), letters.end());
    if (soup.cells.empty())
      refuse_mesh(dim, message);
    soup.vertices.clear();
    for (const auto &row : coordinates)
    {
      Point<dim> x;
      for (int c = 0; c < dim; ++c)
        x[c] = row[c];
      soup.vertices.push_back(x);
    }
    return soup;
  }

  template SimplexSoup<2> mesh_on_first_rank<2>(const std::function<SimplexSoup<2>()> &, MPI_Comm);
  template SimplexSoup<3> mesh_on_first_rank<3>(const std::function<SimplexSoup<3>()> &, MPI_Comm);
} // namespace swimtwin
