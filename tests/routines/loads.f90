! What is in loads.c, in Fortran. Utilities of the program are called by their names.
subroutine nfosub(id, time, par, npar, dflag, iflag, force)
  implicit none
  integer :: id, npar, dflag, iflag
  double precision :: time, par(*), force(*)
  double precision :: disp(6), velo(6), y(6, 2), angle, k(6), c(6), s(2)
  character(len=2) :: names(3)
  integer :: a, b, r, ipar(4), n, errflg
  k = (/ 30d0, 50d0, 20d0, 4d0, 6d0, 3d0 /)
  c = (/ 1d0, 0.5d0, 2d0, 0.2d0, 0.1d0, 0.3d0 /)
  s = (/ 0.3d0, 0.1d0 /)
  names = (/ 'AX', 'AY', 'AZ' /)
  do a = 1, 2
    ipar = (/ int(par(a)), int(par(3)), int(par(3)), int(par(3)) /)
    call sysary('TDISP', ipar, 3, y(1, a), n, errflg)
    do r = 1, 3
      call sysfnc(names(r), ipar, 2, y(3 + r, a), errflg)
    end do
    call sysary('VEL', ipar, 4, velo, n, errflg)
    do r = 1, 6
      force(6 * (a - 1) + r) = -c(r) * velo(r)
    end do
  end do
  do a = 1, 2
    b = 3 - a
    do r = 1, 6
      force(6 * (a - 1) + r) = force(6 * (a - 1) + r) - k(r) * (y(r, a) + s(a) * y(r, b))
    end do
  end do
end subroutine

subroutine mfosub(id, time, par, npar, dflag, iflag, modloads, nmodes, ncases, scale, number, load)
  implicit none
  integer :: id, npar, dflag, iflag, nmodes, ncases, number
  double precision :: time, par(*), modloads(6 + nmodes, ncases), scale, load(*)
  double precision :: q(1), rate(1)
  integer :: ipar(1), n, errflg, r
  ipar(1) = int(par(1))
  call sysary('Q', ipar, 1, q, n, errflg)
  call sysary('QDOT', ipar, 1, rate, n, errflg)
  do r = 1, 6 + nmodes
    load(r) = (2 - 40 * q(1) - 3 * rate(1)) * modloads(r, 1) + 0.5d0 * modloads(r, 2)
  end do
end subroutine

subroutine cursub(id, par, npar, alpha, iord, iflag, values)
  implicit none
  integer :: id, npar, iord, iflag, r
  double precision :: par(*), alpha, values(3), u, a(4)
  u = par(13) + par(14) * alpha
  do r = 1, 3
    a = par(4 * r - 3:4 * r)
    if (iord == 0) values(r) = a(1) + u * (a(2) + u * (a(3) + u * a(4)))
    if (iord == 1) values(r) = par(14) * (a(2) + u * (2 * a(3) + u * 3 * a(4)))
    if (iord == 2) values(r) = par(14)**2 * (2 * a(3) + 6 * a(4) * u)
  end do
end subroutine
