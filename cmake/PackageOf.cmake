# CPack reads this for each kind of package. A Debian package has files below /usr and /etc; the tarball has
# one folder.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_SET_DESTDIR ON)
  set(CPACK_INSTALL_PREFIX /usr)
endif()
