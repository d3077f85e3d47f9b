#include <datasets/error.h>
#include <datasets/scene.h>
#include <fom/full_order_model.h>
#include <cstdio>
#include <petscsys.h>
#include <deal.II/base/mpi.h>
using namespace swimtwin;
int main(int argc,char**argv){
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1); 
  try{
  std::vector<std::string> over(argv+2,argv+argc);
  Scene s=read_scene(argv[1],over);
  FullOrderModel<2> m(s,MPI_COMM_WORLD);
  std::printf("unknowns %u\n",m.n_unknowns());
  int spp=s.time.steps_per_period; double x0=m.now().configuration.pose.center[0];
  for(int k=1;k<=s.time.n_steps();++k){ m.advance();
    auto&n=m.now(); 
    if(k%std::max(1,spp/20)==0) std::printf("%4d t %.4f it %d x %.6e y %.3e th %.6f tail %.4f q %.3f D %.4e P %.4e W %.3e unk %u rm %d\n",k,n.time_s,m.coupling_iterations_of_last_step(),n.configuration.pose.center[0],n.configuration.pose.center[1],n.configuration.pose.angle,m.swimmer().tail_angle(n.configuration),m.fluid()?m.fluid()->quality():0.,m.balance().dissipation,m.balance().magnetic,m.balance().elastic_energy,m.n_unknowns(),m.counts().n_remeshes);
    if(k%spp==0){ std::printf("period displacement %.8e\n",-(n.configuration.pose.center[0]-x0)); x0=n.configuration.pose.center[0];}
  }
  auto c=m.counts(); auto l=m.linear_counts();
  std::printf("steps %d it %d halv %d solves %d fact %d iters %d | asm %.2f fact %.2f solve %.2f mesh %.2f remesh %.2f coupling %.2f total %.2f\n",c.n_steps,c.n_coupling_iterations,c.n_step_halvings,l.n_solves,l.n_factorizations,l.n_iterations,l.assembly_cpu_s,l.factorization_cpu_s,l.solve_cpu_s,c.mesh_motion_cpu_s,c.remeshing_cpu_s,c.coupling_cpu_s,clock()/1e6);
  }catch(std::exception&e){ std::fprintf(stderr,"%s\n",e.what()); return 1;}
}
