# Builds the source tree that this recipe stands in. Packages are made from a copy of it in Conan's cache.
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class CaromConan(ConanFile):
    name = "carom"
    description = "A 2D rigid-body physics engine"
    license = "MIT"
    topics = ("physics", "2d", "rigid-body", "game-development")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    @property
    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._tree, "include", "carom", "config.h"))
        self.version = re.search(r'define CAROM_VERSION_STRING "(.+?)"', text).group(1)

    def export_sources(self):
        for file in ("CMakeLists.txt", "LICENSE"):
            copy(self, file, self._tree, self.export_sources_folder)
        for folder in ("cmake", "include", "src"):
            copy(self, "*", os.path.join(self._tree, folder), os.path.join(self.export_sources_folder, folder))

    def layout(self):
        self.folders.root = os.path.join("..", "..")
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False
        for part in ("TESTS", "PINBALL", "LAB", "BENCH", "EXAMPLES"):
            toolchain.cache_variables[f"CAROM_BUILD_{part}"] = False
        toolchain.cache_variables["CAROM_INSTALL"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan writes these for its users itself, from package_info.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.libs = ["carom"]
        self.cpp_info.set_property("cmake_file_name", "carom")
        self.cpp_info.set_property("cmake_target_name", "carom::carom")
        self.cpp_info.set_property("pkg_config_name", "carom")
        if self.options.shared:
            self.cpp_info.defines = ["CAROM_SHARED=1"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread"]
