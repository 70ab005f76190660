; A program for a PC that asks the robot on COM1 by INT 14h, the calls of the BIOS for serial ports. It is a program
; for DOS (nasm -d DOS), which writes the reply into the file REPLY, or a boot sector for QEMU, which writes it to the
; debug console and ends QEMU. Instead of a reply that did not come in time it writes "timeout".

        cpu     8086
        bits    16

%ifdef DOS
        org     100h
%else
        org     7c00h
%endif

COM1            equ 0
SETTINGS_7E2    equ 0feh        ; 9600 baud, 7 data bits, even parity, 2 stop bits
SET_UP          equ 0           ; the calls of INT 14h, in AH
SEND            equ 1
RECEIVE         equ 2
IS_TIMEOUT      equ 80h         ; in AH afterwards

start:
        xor     ax, ax
%ifndef DOS
        mov     ds, ax
        mov     ss, ax
        mov     sp, 7c00h
%endif
        cld
        mov     al, SETTINGS_7E2
        mov     dx, COM1
        int     14h

        mov     si, question
.send:  lodsb
        mov     ah, SEND
        int     14h
        cmp     si, question_end
        jb      .send

        mov     ah, RECEIVE
        int     14h
        test    ah, IS_TIMEOUT
        mov     si, timeout
        mov     cx, timeout_end - timeout
        jnz     report
        mov     [reply], al
        mov     si, reply
        mov     cx, 1

; report: writes CX bytes at SI and ends.
report:
%ifdef DOS
        push    cx
        mov     ah, 3ch         ; create a file
        xor     cx, cx
        mov     dx, file
        int     21h
        mov     bx, ax
        mov     ah, 40h         ; write to it
        mov     dx, si
        pop     cx
        int     21h
        mov     ax, 4c00h       ; end; this closes it
        int     21h
file:   db      'REPLY', 0
%else
        mov     dx, 0e9h        ; -debugcon
.write: lodsb
        out     dx, al
        loop    .write
        mov     dx, 0f4h        ; -device isa-debug-exit,iobase=0xf4
        out     dx, al
.halt:  hlt
        jmp     .halt
%endif

question:       db 'E+50', 13, 'E?'
question_end:
timeout:        db 'timeout'
timeout_end:
reply:          db 0

%ifndef DOS
        times   510 - ($ - $$) db 0
        dw      0aa55h
%endif
