# The files that `cmake --install` installs, and the tarball and the Debian package that CPack makes of them.
# The reasons are in docs/decisions/0028-packages.md. The page is a part of the program.
set(manual "${PROJECT_BINARY_DIR}/cli/manual")
set(doc "${CMAKE_INSTALL_DATADIR}/doc/xr3")
install(TARGETS xr3)
install(DIRECTORY data/ DESTINATION "${CMAKE_INSTALL_DATADIR}/xr3")
install(DIRECTORY build/site/ DESTINATION "${CMAKE_INSTALL_DATADIR}/xr3/docs" OPTIONAL  # by scripts/site
  PATTERN "*.map" EXCLUDE REGEX "/site/play$" EXCLUDE)
install(DIRECTORY build/playground/ DESTINATION "${CMAKE_INSTALL_DATADIR}/xr3/play" OPTIONAL)  # by scripts/playground
install(DIRECTORY docs/course/ DESTINATION "${CMAKE_INSTALL_DATADIR}/xr3/exercises")
install(DIRECTORY "${manual}/" DESTINATION "${CMAKE_INSTALL_DATADIR}" PATTERN zsh EXCLUDE)
install(DIRECTORY clients/python/ DESTINATION "${CMAKE_INSTALL_DATADIR}/xr3/python"
  PATTERN tests EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN pyproject.toml EXCLUDE)
install(FILES README.md CHANGELOG.md SECURITY.md DESTINATION "${doc}")
install(FILES LICENSE DESTINATION "${doc}" RENAME copyright)
install(FILES deploy/systemd/xr3.toml DESTINATION "${doc}")

# The unit names the program by its absolute path: /usr in a system's own package, which also writes below
# /etc; else /usr/local, as in the checkout.
install(CODE "
  file(READ \"${PROJECT_SOURCE_DIR}/deploy/systemd/xr3.service\" unit)
  if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
    string(REPLACE /usr/local/bin/ /usr/bin/ unit \"\${unit}\")
  endif()
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/systemd/system\")
  file(MAKE_DIRECTORY \"\${folder}\")
  file(WRITE \"\${folder}/xr3.service\" \"\${unit}\")
  if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
    file(INSTALL \"${PROJECT_SOURCE_DIR}/deploy/systemd/xr3.toml\" DESTINATION /etc/xr3)
  endif()")

# zsh has a folder for the completions of packages, and another one for those of the machine.
install(CODE "
  set(functions site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL /usr)
    set(functions vendor-completions)
  endif()
  file(INSTALL \"${manual}/zsh/vendor-completions/_xr3\"
    DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/zsh/\${functions}\")")

# Shared libraries that have no static form here go with the program.
if(XR3_PORTABLE)
  set_target_properties(xr3 PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/xr3")
  set(libraries ${PROMETHEUS_LINK_LIBRARIES})
  foreach(name libstdc++.so.6 libgcc_s.so.1)
    execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=${name}
      OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND libraries "${path}")
  endforeach()
  foreach(library ${libraries})
    execute_process(COMMAND "${CMAKE_OBJDUMP}" -p "${library}" OUTPUT_VARIABLE header
      COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCH "SONAME +([^ \n]+)" found "${header}")
    set(soname "${CMAKE_MATCH_1}")
    file(REAL_PATH "${library}" file)
    install(PROGRAMS "${file}" DESTINATION lib/xr3 RENAME "${soname}")
  endforeach()
  install(DIRECTORY "${PROJECT_BINARY_DIR}/licences" DESTINATION "${doc}")  # by scripts/package
endif()

# (uname -m and Debian have different names.)
set(debian_name_of_x86_64 amd64)
set(debian_name_of_aarch64 arm64)
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME xr3)
set(CPACK_PACKAGE_VENDOR "The xr3 authors")
set(CPACK_PACKAGE_CONTACT "The xr3 authors <xr3@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulated controller of a Rhino XR-3 robot on TCP ports")
set(CPACK_PACKAGE_DESCRIPTION "Each TCP connection is a serial line that speaks the protocol of the Rhino XR-3, \
so that programs for the real arm run unchanged. A monitor port streams the state as JSON, and a browser page \
shows the robot, its blocks and its camera.")
set(CPACK_PACKAGE_FILE_NAME "xr3-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE "${debian_name_of_${CMAKE_SYSTEM_PROCESSOR}}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6 (>= 2.36)")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ncurses-base, bubblewrap")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/deploy/debian/postinst"
  "${PROJECT_SOURCE_DIR}/deploy/debian/prerm" "${PROJECT_SOURCE_DIR}/deploy/debian/postrm"
  "${PROJECT_SOURCE_DIR}/deploy/debian/conffiles")
set(CPACK_PROJECT_CONFIG_FILE "${PROJECT_SOURCE_DIR}/cmake/PackageOf.cmake")
include(CPack)
