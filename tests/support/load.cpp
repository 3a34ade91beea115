#include "load.h"

#include "vcg_ext/mesh.h"

#include <stdexcept>
#include <wrap/io_trimesh/import_off.h>

vcg_ext::Surface load(const std::string& name)
{
    const std::string path = std::string(DATA_DIR) + "/" + name;
    vcg_ext::Mesh mesh;
    int mask = 0;
    const int error = vcg::tri::io::ImporterOFF<vcg_ext::Mesh>::Open(mesh, path.c_str(), mask);
    if (error && mesh.FN() == 0)
        throw std::runtime_error(path + ": " + vcg::tri::io::ImporterOFF<vcg_ext::Mesh>::ErrorMsg(error));
    return vcg_ext::to_surface(mesh);
}
