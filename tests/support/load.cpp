// SPDX-License-Identifier: GPL-3.0-or-later
#include "load.h"

#include "vcg_ext/base/mesh.h"

#include <filesystem>
#include <stdexcept>
#include <unistd.h>
#include <wrap/io_trimesh/io_mask.h> // before the exporter, which needs it

#include <wrap/io_trimesh/export_stl.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>
#include <wrap/io_trimesh/import_stl.h>

namespace {

template <class Importer>
vcg_ext::Surface load_by(const std::string& path)
{
    vcg_ext::Mesh mesh;
    int mask = 0;
    const int error = Importer::Open(mesh, path.c_str(), mask);
    if (error && mesh.FN() == 0)
        throw std::runtime_error(path + ": " + Importer::ErrorMsg(error));
    return vcg_ext::to_surface(mesh);
}

} // namespace

vcg_ext::Surface load(const std::string& name)
{
    return load_file(std::string(DATA_DIR) + "/" + name);
}

vcg_ext::Surface load_file(const std::string& path)
{
    const std::string ending = path.substr(path.size() - 4);
    if (ending == ".ply")
        return load_by<vcg::tri::io::ImporterPLY<vcg_ext::Mesh>>(path);
    if (ending == ".stl")
        return load_by<vcg::tri::io::ImporterSTL<vcg_ext::Mesh>>(path);
    return load_by<vcg::tri::io::ImporterOFF<vcg_ext::Mesh>>(path);
}

vcg_ext::Surface through_stl(const vcg_ext::Surface& surface)
{
    vcg_ext::Mesh mesh;
    vcg_ext::to_mesh(surface, mesh);
    const auto path = std::filesystem::temp_directory_path() / (std::to_string(getpid()) + ".stl");
    using Exporter = vcg::tri::io::ExporterSTL<vcg_ext::Mesh>;
    if (const int error = Exporter::Save(mesh, path.c_str()))
        throw std::runtime_error(path.string() + ": " + Exporter::ErrorMsg(error));
    vcg_ext::Surface result = load_by<vcg::tri::io::ImporterSTL<vcg_ext::Mesh>>(path);
    std::filesystem::remove(path);
    return result;
}
