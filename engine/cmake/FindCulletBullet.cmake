# Bullet's own package file names relative folders on Debian; CMake's module finds it but makes no target. This makes one.
find_package(Bullet MODULE QUIET)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CulletBullet REQUIRED_VARS BULLET_LIBRARIES BULLET_INCLUDE_DIRS)
if(CulletBullet_FOUND AND NOT TARGET CulletBullet::bullet)
  add_library(CulletBullet::bullet INTERFACE IMPORTED)
  set_target_properties(CulletBullet::bullet PROPERTIES
    INTERFACE_LINK_LIBRARIES "${BULLET_LIBRARIES}"
    INTERFACE_INCLUDE_DIRECTORIES "${BULLET_INCLUDE_DIRS}")
endif()
