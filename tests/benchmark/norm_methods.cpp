// The six methods of vertex norms on four meshes: distortion beside the thesis' Table 5.3, and what placing cost.

#include "support/load.h"
#include "vcg_ext/metric/displacement.h"
#include "vcg_ext/watermark.h"

#include <cstdio>

using namespace vcg_ext;

int main()
{
    const Key key("norm_methods");
    for (const char* mesh : {"bunny00.off", "fandisk.off", "armadillo.off", "refined_elephant.off"}) {
        const Surface cover = load(mesh);
        const double diagonal = bounding_diagonal(cover);
        std::printf("%s: %zu vertices, %zu faces\n", mesh, cover.points.size(), cover.triangles.size());
        for (const Statistic statistic : {Statistic::Mean, Statistic::Variance}) {
            double cho = 0;
            for (const Method method : {Method::Cho, Method::QSP, Method::LM}) {
                Surface stego = cover;
                EmbedOptions options;
                options.method = method;
                options.statistic = statistic;
                options.message = parse_message("hex:0123456789abcdef");
                options.trim = 0.1;
                options.storage = Storage::Float;
                const EmbedReport r = embed(stego, key, options);
                if (method == Method::Cho)
                    cho = r.mrms;
                std::string seconds;
                for (const auto& [phase, s] : r.seconds)
                    seconds += " " + phase + " " + std::to_string(s);
                std::printf("  %-4s%-9s MRMS/diagonal %.2e  / Cho %.3f  max %.1e  rounds %d  guarded %d  iterations "
                            "%.1f (%d)  unconverged %d  %s\n",
                            name(method), name(statistic), r.mrms / diagonal, r.mrms / cho,
                            r.max_displacement / diagonal, r.rounds, r.guarded_vertices,
                            r.solver ? r.solver->mean_iterations : 0.0, r.solver ? r.solver->max_iterations : 0,
                            r.solver ? r.solver->not_converged : 0, seconds.c_str());
            }
        }
    }
}
